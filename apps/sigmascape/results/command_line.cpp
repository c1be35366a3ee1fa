#include "results/command_line.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace sigmascape::cli {
namespace {

std::string option(const char* name, const std::string& value) {
  return value.empty() ? std::string() : fmt::format(" {} {}", name, value);
}

}  // namespace

std::string path_within(const std::string& path) {
  if (path.empty()) return {};
  const auto relative =
      std::filesystem::absolute(path).lexically_normal().lexically_relative(std::filesystem::current_path());
  return relative.empty() || *relative.begin() == ".." ? std::string() : relative.generic_string();
}

std::string command_line(const ResultsOptions& options, const ResultsPlan& plan) {
  const ResultsOptions usual;
  const auto views = [&](ViewKind kind) { return std::ranges::count(plan.views, kind, &PlannedView::kind); };
  std::string line = "sigmascape results";
  if (options.small) line += " --small";
  if (options.without_finest_grid) line += " --no-finest-grid";
  if (!options.scene_file.empty()) {
    const std::string within = path_within(options.scene_file);
    line += option("--scene",
                   within.empty() ? std::filesystem::path(options.scene_file).filename().generic_string() : within);
  }
  if (!options.around_m.empty()) line += fmt::format(" --around {} {}", plan.around_m.x, plan.around_m.y);
  if (options.itu_materials) line += " --itu-materials";
  line += fmt::format(" --scale {} --held-out {} --on-grid {} --repeated {} --samples {} --traced-samples {}",
                      plan.scale, views(ViewKind::HeldOut), views(ViewKind::OnGrid), options.repeated,
                      plan.baked_samples, plan.traced_samples);
  if (plan.most_traced_samples > plan.traced_samples)
    line += fmt::format(" --most-traced-samples {}", plan.most_traced_samples);
  line += fmt::format(" --finer-samples {}", plan.finer_samples);
  if (plan.bounces != usual.bounces) line += fmt::format(" --bounces {}", plan.bounces);
  if (plan.seed != usual.seed) line += fmt::format(" --seed {}", plan.seed);
  if (options.threads != usual.threads) line += fmt::format(" --threads {}", options.threads);
  line += option("--out", path_within(options.folder));
  if (!options.page.empty()) line += option("--page", path_within(options.page));
  return line;
}

}  // namespace sigmascape::cli
