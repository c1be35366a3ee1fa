#include <exception>
#include <fmt/format.h>

#include "command.h"

#include "sigmascape/base/error.h"

namespace sigmascape::cli {

void Output::finish(const std::string& text, const nlohmann::ordered_json& summary) const {
  fmt::print("{}\n", json ? summary.dump(2) : text);
}

}  // namespace sigmascape::cli

int main(int argc, char** argv) {
  using namespace sigmascape;  // NOLINT(google-build-using-namespace)
  CLI::App app{
      "Sigmascape: what a radar sees of a landscape.\n"
      "Path-traces a scene at radio frequencies, bakes it into reflectivity textures, and renders ground maps from "
      "either."};
  app.require_subcommand(1);
  app.set_version_flag("--version", "0.1.0");
  cli::Output output;
  cli::add_scene_command(app, output);
  cli::add_bake_command(app, output);
  cli::add_render_command(app, output);
  cli::add_compare_command(app, output);
  cli::add_demo_command(app, output);
  cli::add_results_command(app, output);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& wrong_use) {
    return app.exit(wrong_use) == 0 ? 0 : 2;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "sigmascape: {}\n", failure.what());
    return 1;
  }
  return 0;
}
