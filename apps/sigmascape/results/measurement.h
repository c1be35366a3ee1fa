#pragma once

#include <functional>
#include <optional>
#include <string>

#include "results/bake.h"
#include "results/measured.h"
#include "results/paper_bake.h"
#include "results/plan.h"
#include "results/table.h"
#include "results/truth.h"
#include "terminal_progress.h"

#include "sigmascape/render/ground_renderer.h"

namespace sigmascape::cli {

/// What is seen of a scene: where the radar stands and what it maps.
struct Seen {
  const MeasuredScene& measured;
  radar::Radar radar;
  radar::GroundGrid grid;
};

/// One way to a map, ready to be used: mostly an atlas in memory and how maps are rendered from it.
struct ReadyMethod {
  Method method = Method::OwnGround;
  std::string grid;
  std::uint32_t baked_samples = 0;
  std::string change = {};
  AtlasCost cost;
  std::function<radar::RangeAzimuthImage(const Seen& seen, int level_of_detail)> render;
};

struct RenderedMap {
  radar::GroundMap map;
  double milliseconds = 0.0;  ///< of processor time
};

/// Bakes, traces, renders and compares everything that a plan asks for.
class Measurement {
 public:
  /// Bakes. What lies in `folder` from an earlier run is used again; views that are in the file `measured`, unless
  /// empty, are not measured again: they are traced only to be shown, or where a method has been added since.
  Measurement(const ResultsPlan& plan, const std::filesystem::path& folder, const std::filesystem::path& measured);

  /// Every view is kept in `kept_file` once it is done.
  void compare_all();
  [[nodiscard]] std::filesystem::path kept_file() const { return folder_ / "measured.json"; }
  /// Writes a file like that one of the views alone that results() are of: others may be kept of other plans. That one
  /// itself stays as it is.
  void write_told(const std::filesystem::path& file) const;

  [[nodiscard]] const std::vector<ViewResult>& results() const { return results_; }
  /// Those that times were taken on, in a row.
  [[nodiscard]] std::string machines() const;
  [[nodiscard]] const MeasuredScene& scene() const { return scene_; }

  /// With the rays that it was measured with.
  [[nodiscard]] Truth truth_of(const PlannedView& view) const;
  /// The scene as it is, from a grid that the method has.
  [[nodiscard]] radar::GroundMap map_of(const PlannedView& view, Method method, const std::string& grid) const;
  /// The textures of the paper's grid by themselves, texel by texel, with all that they hold.
  [[nodiscard]] const render::PaperTextures& paper_textures() const { return *paper_textures_; }

 private:
  [[nodiscard]] ReadyMethod from_store(Method method, const std::string& grid, std::uint32_t samples,
                                       const TimedBake& bake, const atlas::AspectSelection& selection) const;
  [[nodiscard]] ReadyMethod from_paper_textures(const std::string& grid, std::uint32_t samples,
                                                const std::string& change, const AtlasCost& cost,
                                                std::shared_ptr<const render::PaperTextures> textures,
                                                const render::PaperLookUp& look_up) const;
  [[nodiscard]] ReadyMethod from_few_rays(std::uint32_t samples) const;
  void make_ready();
  /// Of one that is kept what it lacks.
  void compare_once(const MeasuredScene& measured, PlannedView view);
  [[nodiscard]] bool can_add_ways_to(const std::vector<std::pair<const MeasuredScene*, PlannedView>>& views) const;
  [[nodiscard]] std::vector<const ReadyMethod*> lacking_in(const MeasuredScene& measured,
                                                           const MeasuredView& kept) const;
  /// From all views, what one that is kept lacks.
  void leave_out_what_lacks(const MeasuredScene& measured, const PlannedView& view);
  void compare_what_lacks(const MeasuredScene& measured, MeasuredView kept);
  [[nodiscard]] bool is_for(const MeasuredScene& measured, const ReadyMethod& method) const;
  /// Views that were not baked and whose traced maps do not agree, with as many rays as the plan has for them.
  void compare_anew_what_disagrees();
  void compare(const MeasuredScene& measured, const PlannedView& view);
  void compare_own_looks(const Truth& truth, const MeasuredScene& measured, const PlannedView& view);
  void compare_renormalized(const Truth& truth, const PlannedView& view);
  /// The view's own look, baked for it.
  [[nodiscard]] ReadyMethod own_look_of(Method method, const MeasuredScene& measured, const PlannedView& view,
                                        std::uint32_t samples, std::uint64_t seed);
  /// As `sigmascape bake` samples it by itself.
  [[nodiscard]] ReadyMethod own_look_with_rays_where_noise_is(Method method, const MeasuredScene& measured,
                                                              const PlannedView& view);
  /// The same almost without noise, baked on texels half as wide.
  [[nodiscard]] ReadyMethod own_look_in_finer_texels(Method method, const MeasuredScene& measured,
                                                     const PlannedView& view);
  [[nodiscard]] bake::BakeSettings own_look_settings(Method method, const PlannedView& view,
                                                     std::uint32_t samples) const;
  /// Baked in a folder named after the scene, the view, its rays and `ending`.
  [[nodiscard]] ReadyMethod own_look_from(const bake::BakeSettings& settings, Method method,
                                          const MeasuredScene& measured, const PlannedView& view,
                                          const std::string& ending);
  /// Renders and compares; with `again`, which differs from `method` in its seed alone, without noise as well.
  void hold_against(const Truth& truth, const MeasuredScene& measured, const PlannedView& view,
                    const ReadyMethod& method, int level_of_detail = 1, const ReadyMethod* again = nullptr);
  [[nodiscard]] ViewResult result_of(const Truth& truth, const MeasuredScene& measured, const PlannedView& view,
                                     const ReadyMethod& method, const RenderedMap& rendered) const;
  [[nodiscard]] const ReadyMethod& ready(Method method, const std::string& grid) const;
  [[nodiscard]] radar::GroundMap middle_of(const radar::GroundMap& map) const;
  [[nodiscard]] RenderedMap rendered_map(const MeasuredScene& measured, const PlannedView& view,
                                         const ReadyMethod& method, int level_of_detail) const;

  const ResultsPlan& plan_;
  std::filesystem::path folder_;
  TerminalProgress progress_;
  MeasuredScene scene_;
  MeasuredViews kept_;
  std::optional<MeasuredScene> level_;
  PaperBake paper_bake_, paper_bake_again_;
  TimedBake baked_shadows_, level_ground_, own_ground_, buildings_apart_, even_in_cotangent_, shared_noise_;
  std::optional<TimedBake> default_;  ///< as `sigmascape bake` samples by default
  std::shared_ptr<const render::PaperTextures> paper_textures_;
  std::vector<ReadyMethod> methods_;
  std::vector<ViewResult> results_;
  std::vector<const MeasuredView*> told_;  ///< of `kept_`, to which nothing is added once all is compared
};

}  // namespace sigmascape::cli
