#include "results/measurement.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>
#include <set>
#include <system_error>
#include <tuple>

#include "map_files.h"
#include "results/tile_power.h"
#include "scene_warnings.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_name.h"
#include "sigmascape/base/processor_stopwatch.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::cli {
namespace {

constexpr int coarsest_level_of_detail = 3;
constexpr std::uint64_t seed_of_few_rays = 501;  // none of the truth's

struct PaperChange {
  const char* name;
  render::PaperLookUp look_up;
};

constexpr PaperChange paper_changes[] = {
    {cotangent_change, {.by_cotangent = true}},
    {gamma_change, {.blends_gamma = true}},
    {cotangent_gamma_change, {.by_cotangent = true, .blends_gamma = true}},
    {map_area_change, {.by_map_area = true}},
    {middle_change, {.in_the_middle = true}},
    {finest_change, {.finest_only = true}},
};

/// The paper's scene, or the middle of another.
scene::Scene scene_of(const ResultsPlan& plan) {
  if (plan.scene_file.empty()) return scene::paper_scene({.scale = plan.scale, .materials = plan.materials});
  scene::Scene scene = scene::read_scene(plan.scene_file);
  warn_of_scene(scene);
  const radar::Rectangle& all = scene.extent;
  constexpr double rounding_m = 1e-6;
  const double half_m = plan.side_m() / 2.0, most_m = std::min(all.width_m(), all.height_m());
  if (plan.side_m() > most_m + rounding_m) {
    throw Error("--scale",
                fmt::format("{:g} asks for {:g} m, and the scene is {:g} m wide", plan.scale, plan.side_m(), most_m),
                fmt::format("give one of at most {:g}", plan.scale * most_m / plan.side_m()));
  }
  const Vec2d centre = all.centre() + plan.around_m;
  const radar::Rectangle part{centre.x - half_m, centre.y - half_m, centre.x + half_m, centre.y + half_m};
  if (!radar::holds(radar::widened(all, rounding_m), part)) {
    throw Error(
        "--around",
        fmt::format("{:g} m around ({:g}, {:g}) m reach beyond the scene", half_m, plan.around_m.x, plan.around_m.y),
        fmt::format("choose a place within {:g} m east or west and {:g} m north or south of the scene's middle",
                    all.width_m() / 2.0 - half_m, all.height_m() / 2.0 - half_m));
  }
  scene.extent = radar::common_part(part, all);
  return scene;
}

std::uint64_t seed_of_repeats(const ResultsPlan& plan) {
  return plan.seed + 1;
}

/// The map with its rim unseen.
radar::GroundMap without_rim(radar::GroundMap map, double rim_m) {
  const radar::Rectangle all = map.grid.extent();
  const radar::Rectangle middle = radar::widened(all, -rim_m);
  constexpr float unseen = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (!middle.contains(map.grid.centre_of(column, row))) map.sigma0(column, row) = {unseen, unseen, unseen, unseen};
    }
  }
  return map;
}

atlas::AspectGrid grid_of_view(const PlannedView& view) {
  return {{radians_from_deg(view.azimuth_deg)}, {radians_from_deg(view.elevation_deg)}, {10e9}};
}

/// Asked before any work, since a file of other settings is refused.
MeasuredViews kept_views(const ResultsPlan& plan, const scene::Scene& scene, const std::filesystem::path& file,
                         const std::filesystem::path& measured) {
  std::filesystem::create_directories(file.parent_path());
  MeasuredViews kept(file, settings_of_views(plan, scene::scene_hash(scene) + scene::targets_hash(scene)));
  kept.go_on();
  if (!measured.empty()) kept.take_over(measured);
  return kept;
}

bake::BakeSettings settings_even_in_cotangent(const ResultsPlan& plan) {
  bake::BakeSettings settings = plan.bake_settings(Method::OwnGround);
  settings.aspects = plan.even_in_cotangent().aspects();
  return settings;
}

bake::BakeSettings settings_of_shared_noise(const ResultsPlan& plan) {
  bake::BakeSettings settings = plan.bake_settings(Method::OwnGround);
  settings.aspects = plan.paper_grid().aspects();
  settings.noise = bake::Noise::Shared;
  return settings;
}

bake::BakeSettings settings_of_default_bake(const ResultsPlan& plan) {
  bake::BakeSettings settings = plan.bake_settings(Method::OwnGround);
  settings.aspects = plan.next_grid().aspects();
  settings.sampling.samples_per_texel = 0;
  return settings;
}

}  // namespace

Measurement::Measurement(const ResultsPlan& plan, const std::filesystem::path& folder,
                         const std::filesystem::path& measured)
    : plan_(plan),
      folder_(folder),
      scene_(plan.scene_name(), scene_of(plan)),
      kept_(kept_views(plan, scene_.scene, kept_file(), measured)),
      paper_bake_(plan, scene_.scene, folder / "paper", plan.seed),
      paper_bake_again_(plan, scene_.scene, folder / "paper_again", seed_of_repeats(plan)),
      baked_shadows_(scene_.scene, plan.bake_settings(Method::BakedShadows), folder / "atlas_baked_shadows", progress_),
      level_ground_(scene_.scene, plan.bake_settings(Method::LevelGround), folder / "atlas_level_ground", progress_),
      own_ground_(scene_.scene, plan.bake_settings(Method::OwnGround), folder / "atlas_own_ground", progress_),
      buildings_apart_(scene_.scene, plan.bake_settings(Method::Apart), folder / "atlas_buildings_apart", progress_),
      even_in_cotangent_(scene_.scene, settings_even_in_cotangent(plan), folder / "atlas_even_in_cotangent", progress_),
      shared_noise_(scene_.scene, settings_of_shared_noise(plan), folder / "atlas_shared_noise", progress_) {
  if (plan.has_default_bake)
    default_.emplace(scene_.scene, settings_of_default_bake(plan), folder / "atlas_default", progress_);
  if (plan.has_level_ground()) level_.emplace("level", levelled(scene_.scene));
  make_ready();
}

ReadyMethod Measurement::from_store(Method method, const std::string& grid, std::uint32_t samples,
                                    const TimedBake& bake, const atlas::AspectSelection& selection) const {
  const auto atlas = std::make_shared<const atlas::Atlas>(atlas::load_atlas(bake.store(), {.aspects = selection}));
  const unsigned threads = plan_.threads;
  return {.method = method,
          .grid = grid,
          .baked_samples = samples,
          .cost = bake.cost_of(selection, *atlas),
          .render = [atlas, threads](const Seen& seen, int level_of_detail) {
            render::RenderCounts counts;
            const scene::Scene& scene = seen.measured.scene;
            const std::vector<radar::Target> targets = simulate::targets_of(scene);
            return simulate::baked_image(*atlas, scene.terrain, seen.radar, seen.grid.extent(),
                                         {.level_of_detail = level_of_detail, .threads = threads, .targets = targets},
                                         counts);
          }};
}

ReadyMethod Measurement::from_paper_textures(const std::string& grid, std::uint32_t samples, const std::string& change,
                                             const AtlasCost& cost,
                                             std::shared_ptr<const render::PaperTextures> textures,
                                             const render::PaperLookUp& look_up) const {
  const unsigned threads = plan_.threads;
  return {.method = Method::Paper,
          .grid = grid,
          .baked_samples = samples,
          .change = change,
          .cost = cost,
          .render = [textures = std::move(textures), look_up, threads](const Seen& seen, int) {
            const scene::Scene& scene = seen.measured.scene;
            const auto bins = simulate::bins_for(seen.radar, seen.grid.extent(), scene.terrain);
            auto image =
                render::paper_image(*textures, scene.terrain, seen.radar, seen.grid.extent(), bins, look_up, threads);
            simulate::add_targets(image, seen.radar, {scene.terrain}, simulate::targets_of(scene), {});
            return image;
          }};
}

ReadyMethod Measurement::from_few_rays(std::uint32_t samples) const {
  return {.method = Method::Traced,
          .grid = {},
          .baked_samples = samples,
          .cost = {},
          .render = [&plan = plan_, samples](const Seen& seen, int) {
            return traced_image(seen.measured, seen.radar, seen.grid, plan, samples, seed_of_few_rays);
          }};
}

void Measurement::make_ready() {
  const auto paper = [&](const LookGrid& grid, const std::string& change, bool in_halves) {
    PaperAtlas made = paper_bake_.atlas_of(grid.aspects(), plan_.baked_samples, progress_, in_halves);
    auto textures = std::make_shared<const render::PaperTextures>(std::move(made.textures));
    methods_.push_back(from_paper_textures(grid.name(), plan_.baked_samples, change, made.cost, textures, {}));
    return std::pair(textures, made.cost);
  };
  const LookGrid& grid = plan_.paper_grid();
  AtlasCost cost;
  std::shared_ptr<const render::PaperTextures> textures;
  for (const LookGrid& looks : plan_.grids) {
    auto made = paper(looks, "", false);
    if (looks.name() == grid.name()) std::tie(textures, cost) = std::move(made);
  }
  paper_textures_ = textures;
  for (const PaperChange& change : paper_changes) {
    methods_.push_back(
        from_paper_textures(grid.name(), plan_.baked_samples, change.name, cost, textures, change.look_up));
  }
  paper(grid, halves_change, true);

  const auto ours = [&](Method method, const LookGrid& looks, const TimedBake& bake, const char* change = "") {
    const auto selection = ResultsPlan::selection_of(looks, bake.store().description().aspects);
    methods_.push_back(from_store(method, looks.name(), plan_.baked_samples, bake, selection));
    methods_.back().change = change;
  };
  ours(Method::BakedShadows, plan_.grids.front(), baked_shadows_);
  ours(Method::BakedShadows, grid, baked_shadows_);
  ours(Method::LevelGround, plan_.grids.front(), level_ground_);
  ours(Method::LevelGround, grid, level_ground_);
  for (const LookGrid& looks : plan_.grids) ours(Method::OwnGround, looks, own_ground_);
  ours(Method::Apart, grid, buildings_apart_);
  if (plan_.finest_grid_apart().name() != grid.name()) ours(Method::Apart, plan_.finest_grid_apart(), buildings_apart_);
  ours(Method::OwnGround, plan_.more_elevations(), own_ground_);
  ours(Method::OwnGround, plan_.more_azimuths(), own_ground_);
  ours(Method::OwnGround, plan_.even_in_cotangent(), even_in_cotangent_);
  ours(Method::OwnGround, grid, shared_noise_, shared_noise_change);
  if (default_) {
    for (const LookGrid& looks : {grid, plan_.next_grid()}) {
      ours(Method::OwnGround, looks, *default_, adaptive_change);
      methods_.back().baked_samples = 0;
    }
  }
  for (const std::uint32_t samples : ResultsPlan::few_traced_samples) {
    if (samples < plan_.traced_samples) methods_.push_back(from_few_rays(samples));
  }
}

void Measurement::compare_all() {
  std::vector<std::pair<const MeasuredScene*, PlannedView>> all;
  for (const PlannedView& view : plan_.views) {
    all.emplace_back(&scene_, view);
    // Level ground tells what hills add; missing angles would hide that.
    if (level_ && view.kind == ViewKind::OnGrid) all.emplace_back(&*level_, view.from_afar());
  }
  // The bakes have found that the folder is of this scene.
  kept_.write();
  if (!can_add_ways_to(all)) {
    for (const auto& [measured, view] : all) leave_out_what_lacks(*measured, view);
  }
  std::size_t done = 0;
  for (const auto& [measured, view] : all) {
    compare_once(*measured, view);
    progress_.advanced("compare", static_cast<double>(++done), static_cast<double>(all.size()), "views");
  }
  compare_anew_what_disagrees();
  for (const auto& [measured, view] : all) {
    const MeasuredView* kept = kept_.find(measured->name, view);
    results_.insert(results_.end(), kept->results.begin(), kept->results.end());
    told_.push_back(kept);
  }
  std::ranges::stable_sort(results_, {}, [](const ViewResult& result) {
    return std::tuple(result.of.scene, static_cast<int>(result.of.kind), static_cast<int>(result.of.method));
  });
}

void Measurement::write_told(const std::filesystem::path& file) const {
  std::error_code absent;
  if (!std::filesystem::equivalent(file, kept_file(), absent)) kept_.write(file, told_);
}

std::string Measurement::machines() const {
  std::set<std::string> names;
  for (const MeasuredView* view : told_) names.insert(view->machines.begin(), view->machines.end());
  return fmt::format("{}", fmt::join(names, " and "));
}

void Measurement::compare_once(const MeasuredScene& measured, PlannedView view) {
  if (const MeasuredView* kept = kept_.find(measured.name, view)) {
    return compare_what_lacks(measured, *kept);
  }
  // Maps of more rays serve as well, but on the grid, where looks are baked with as many.
  if (view.kind != ViewKind::OnGrid)
    view.traced_samples = std::max(view.traced_samples, samples_kept(measured, view, plan_, folder_ / "truth"));
  compare(measured, view);
  kept_.add({measured.name, view, {machine_name()}, std::exchange(results_, {})});
}

/// Of views that another folder has measured truths are not there. Rows of ways that came since would be of fewer views
/// than those beside them.
bool Measurement::can_add_ways_to(const std::vector<std::pair<const MeasuredScene*, PlannedView>>& views) const {
  return std::ranges::all_of(views, [&](const auto& each) {
    const MeasuredView* kept = kept_.find(each.first->name, each.second);
    return kept == nullptr ||
           samples_kept(*each.first, kept->view, plan_, folder_ / "truth") >= kept->view.traced_samples;
  });
}

std::vector<const ReadyMethod*> Measurement::lacking_in(const MeasuredScene& measured, const MeasuredView& kept) const {
  std::vector<const ReadyMethod*> lacking;
  for (const ReadyMethod& method : methods_) {
    const bool is_there = std::ranges::any_of(kept.results, [&](const ViewResult& result) {
      return result.of.method == method.method && result.of.grid == method.grid && result.of.change == method.change &&
             result.of.baked_samples == method.baked_samples;
    });
    if (!is_there && is_for(measured, method)) lacking.push_back(&method);
  }
  return lacking;
}

void Measurement::leave_out_what_lacks(const MeasuredScene& measured, const PlannedView& view) {
  const MeasuredView* kept = kept_.find(measured.name, view);
  if (kept == nullptr) return;
  const std::vector<const ReadyMethod*> lacking = lacking_in(measured, *kept);
  std::vector<ReadyMethod> all;
  for (const ReadyMethod& method : methods_) {
    if (std::ranges::find(lacking, &method) == lacking.end()) all.push_back(method);
  }
  methods_ = std::move(all);
}

/// Ways that came after the view was measured.
void Measurement::compare_what_lacks(const MeasuredScene& measured, MeasuredView kept) {
  const std::vector<const ReadyMethod*> lacking = lacking_in(measured, kept);
  if (lacking.empty()) return;
  const Truth truth = traced_truth(measured, kept.view, plan_, folder_ / "truth");
  for (const ReadyMethod* method : lacking) hold_against(truth, measured, kept.view, *method);
  std::ranges::move(std::exchange(results_, {}), std::back_inserter(kept.results));
  if (std::ranges::find(kept.machines, machine_name()) == kept.machines.end()) kept.machines.push_back(machine_name());
  kept_.add(std::move(kept));
}

/// What was baked on hills does not stand on level ground; what tracing takes is asked of the scene as it is.
bool Measurement::is_for(const MeasuredScene& measured, const ReadyMethod& method) const {
  return &measured == &scene_ || (method.change.empty() && method.method != Method::OwnGround &&
                                  method.method != Method::Apart && method.method != Method::Traced);
}

/// Steep views take the least time, so that most of them agree soonest.
void Measurement::compare_anew_what_disagrees() {
  std::vector<PlannedView> views;
  for (const PlannedView& view : plan_.views) {
    if (view.kind == ViewKind::OnGrid) continue;
    const ViewResult& any = kept_.find(scene_.name, view)->results.front();
    if (agreement(any) < least_agreement) views.push_back(view);
  }
  std::ranges::stable_sort(views, std::ranges::greater(), &PlannedView::elevation_deg);
  std::size_t done = 0;
  for (PlannedView& view : views) {
    view.traced_samples = plan_.most_traced_samples;
    compare_once(scene_, view);
    progress_.advanced("compare anew", static_cast<double>(++done), static_cast<double>(views.size()), "views");
  }
}

void Measurement::compare(const MeasuredScene& measured, const PlannedView& view) {
  const Truth truth = traced_truth(measured, view, plan_, folder_ / "truth");
  const bool is_main = &measured == &scene_;
  for (const ReadyMethod& method : methods_) {
    if (!is_for(measured, method)) continue;
    const bool by_level = is_main && method.method == Method::OwnGround && method.change.empty() &&
                          method.grid == plan_.paper_grid().name();
    for (int level = 1; level <= (by_level ? coarsest_level_of_detail : 1); ++level)
      hold_against(truth, measured, view, method, level);
  }
  if (is_main) compare_renormalized(truth, view);
  compare_own_looks(truth, measured, view);
}

/// What it would bring at most to keep the power of every tile for many looks, and all else for few: a map of the
/// paper's grid whose tiles have the power that they have in one of the grid after it.
void Measurement::compare_renormalized(const Truth& truth, const PlannedView& view) {
  const ReadyMethod& few = ready(Method::OwnGround, plan_.paper_grid().name());
  const ReadyMethod& many = ready(Method::OwnGround, plan_.next_grid().name());
  const RenderedMap reference = rendered_map(scene_, view, many, 1);
  RenderedMap renormalized = rendered_map(scene_, view, few, 1);
  const std::size_t tiles = give_power_of_tiles(renormalized.map, reference.map);
  renormalized.milliseconds += reference.milliseconds;
  ReadyMethod method = few;
  method.change = renormalized_change;
  method.cost.store_bytes += tiles * bytes_a_tile * (many.cost.looks - few.cost.looks);
  results_.push_back(result_of(truth, scene_, view, method, renormalized));
}

ReadyMethod Measurement::own_look_of(Method method, const MeasuredScene& measured, const PlannedView& view,
                                     std::uint32_t samples, std::uint64_t seed) {
  const bool is_again = seed != plan_.seed;
  if (method == Method::Paper) {
    PaperAtlas made = (is_again ? paper_bake_again_ : paper_bake_).atlas_of(grid_of_view(view), samples, progress_);
    auto textures = std::make_shared<const render::PaperTextures>(std::move(made.textures));
    return from_paper_textures(own_look, samples, "", made.cost, textures, {});
  }
  bake::BakeSettings settings = own_look_settings(method, view, samples);
  settings.seed = seed;
  return own_look_from(settings, method, measured, view, is_again ? "_again" : "");
}

ReadyMethod Measurement::own_look_with_rays_where_noise_is(Method method, const MeasuredScene& measured,
                                                           const PlannedView& view) {
  ReadyMethod ready = own_look_from(own_look_settings(method, view, 0), method, measured, view, "_adaptive");
  ready.change = adaptive_change;
  return ready;
}

ReadyMethod Measurement::own_look_in_finer_texels(Method method, const MeasuredScene& measured,
                                                  const PlannedView& view) {
  bake::BakeSettings settings = own_look_settings(method, view, plan_.samples_of_finer_texels());
  settings.patches.texel_m /= 2.0;
  ReadyMethod ready = own_look_from(settings, method, measured, view, "_finer_texels");
  ready.change = finer_texels_change;
  return ready;
}

bake::BakeSettings Measurement::own_look_settings(Method method, const PlannedView& view, std::uint32_t samples) const {
  bake::BakeSettings settings = plan_.bake_settings(method);
  settings.aspects = grid_of_view(view);
  settings.sampling.samples_per_texel = samples;
  return settings;
}

ReadyMethod Measurement::own_look_from(const bake::BakeSettings& settings, Method method, const MeasuredScene& measured,
                                       const PlannedView& view, const std::string& ending) {
  const std::uint32_t samples = settings.sampling.samples_per_texel;
  const auto store = folder_ / "own_look" / fmt::format("{}_{}_{}{}", measured.name, view.file_name(), samples, ending);
  return from_store(method, own_look, samples, TimedBake(scene_.scene, settings, store, progress_), {});
}

/// Without an angle missing, with rays where the noise is too, and of baked views almost without noise as well.
void Measurement::compare_own_looks(const Truth& truth, const MeasuredScene& measured, const PlannedView& view) {
  const Method ours = &measured == &scene_ ? Method::OwnGround : Method::LevelGround;
  const bool is_finer_too = view.kind == ViewKind::OnGrid;
  for (const std::uint32_t samples : {plan_.baked_samples, plan_.finer_samples}) {
    for (const Method method : {Method::Paper, ours}) {
      const ReadyMethod once = own_look_of(method, measured, view, samples, plan_.seed);
      if (view.is_repeated) {
        const ReadyMethod again = own_look_of(method, measured, view, samples, seed_of_repeats(plan_));
        hold_against(truth, measured, view, once, 1, &again);
      } else {
        hold_against(truth, measured, view, once);
      }
    }
    if (!is_finer_too || samples == plan_.finer_samples) break;
  }
  if (is_finer_too || default_)
    hold_against(truth, measured, view, own_look_with_rays_where_noise_is(ours, measured, view));
  if (is_finer_too) hold_against(truth, measured, view, own_look_in_finer_texels(ours, measured, view));
}

void Measurement::hold_against(const Truth& truth, const MeasuredScene& measured, const PlannedView& view,
                               const ReadyMethod& method, int level_of_detail, const ReadyMethod* again) {
  const RenderedMap rendered = rendered_map(measured, view, method, level_of_detail);
  ViewResult result = result_of(truth, measured, view, method, rendered);
  result.of.level_of_detail = level_of_detail;
  if (again != nullptr && result.comparison.at_cell(summary_cell_m) != nullptr) {
    const RenderedMap repeated = rendered_map(measured, view, *again, level_of_detail);
    const radar::GroundMap first = middle_of(rendered.map), second = middle_of(repeated.map);
    const radar::GroundMap first_truth = middle_of(truth.first), second_truth = middle_of(truth.second);
    result.without_noise = product::compare_without_noise({first, second}, {first_truth, second_truth}, summary_cell_m,
                                                          {.polarization = radar::Polarization::Sum});
  }
  results_.push_back(std::move(result));
}

ViewResult Measurement::result_of(const Truth& truth, const MeasuredScene& measured, const PlannedView& view,
                                  const ReadyMethod& method, const RenderedMap& rendered) const {
  const std::vector<double> bounds_db(std::begin(level_bounds_db), std::end(level_bounds_db));
  const product::CompareOptions options{.polarization = radar::Polarization::Sum};
  const radar::GroundMap tested = middle_of(rendered.map), mean = middle_of(truth.mean);
  const radar::GroundMap first = middle_of(truth.first), second = middle_of(truth.second);
  return {.of = {.scene = measured.name,
                 .method = method.method,
                 .grid = method.grid,
                 .baked_samples = method.baked_samples,
                 .kind = view.kind,
                 .change = method.change},
          .view = view,
          .atlas = method.cost,
          .comparison = product::compare_maps(tested, mean, options),
          .noise_floor = product::compare_maps(second, first, options),
          .by_level = product::errors_by_level(tested, mean, bounds_db, summary_cell_m, options),
          .noise_by_level = product::errors_by_level(second, first, mean, bounds_db, summary_cell_m, options),
          .trace_seconds = truth.trace_seconds,
          .render_ms = rendered.milliseconds};
}

radar::GroundMap Measurement::middle_of(const radar::GroundMap& map) const {
  return without_rim(map, plan_.rim_m());
}

const ReadyMethod& Measurement::ready(Method method, const std::string& grid) const {
  return *std::ranges::find_if(methods_, [&](const ReadyMethod& candidate) {
    return candidate.method == method && candidate.grid == grid && candidate.change.empty();
  });
}

RenderedMap Measurement::rendered_map(const MeasuredScene& measured, const PlannedView& view, const ReadyMethod& method,
                                      int level_of_detail) const {
  const scene::Scene& scene = measured.scene;
  const radar::RadarFile file = view.radar();
  const Seen seen{measured, simulate::placed_radar(file, scene.frame, scene.terrain, scene.extent),
                  simulate::map_grid(file.map, scene.extent)};
  const ProcessorStopwatch watch;
  const auto image = method.render(seen, level_of_detail);
  const double milliseconds = 1e3 * watch.seconds();
  return {described_map(image, seen.radar, scene.terrain, seen.grid, scene.frame,
                        {{"scene", scene.name},
                         {"attribution", scene.attribution},
                         {"processing", text_of(method.method) + ", " + method.grid}}),
          milliseconds};
}

Truth Measurement::truth_of(const PlannedView& view) const {
  const MeasuredView* kept = kept_.find(scene_.name, view);
  return traced_truth(scene_, kept != nullptr ? kept->view : view, plan_, folder_ / "truth");
}

radar::GroundMap Measurement::map_of(const PlannedView& view, Method method, const std::string& grid) const {
  return rendered_map(scene_, view, ready(method, grid), 1).map;
}

}  // namespace sigmascape::cli
