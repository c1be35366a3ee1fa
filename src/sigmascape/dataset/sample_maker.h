#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/dataset/dataset_spec.h"
#include "sigmascape/dataset/sample_plan.h"
#include "sigmascape/product/coco.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/layer_stack.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::dataset {

/// What a target returns: as much in VV as in HH, and nothing in HV.
[[nodiscard]] radar::Channels target_channels(double rcs_m2);

/// What shows less of its power than this, 10 dB down, has no box.
inline constexpr double least_part_seen = 0.1;

/// A target as it came out: where its echo lies, if the radar sees it.
struct SampleTarget {
  PlannedTarget planned;
  double part_seen = 0.0;  ///< of its power, that comes past hills, houses and crowns
  bool is_seen = false;    ///< at least `least_part_seen` of it, and some of its response on the map
  product::TargetBox box;  ///< cut to the map
};

/// A map with its labels, cell for cell.
struct Sample {
  SamplePlan plan;
  Vec3d radar_position;
  radar::Aspect aspect;        ///< under which the middle of the map is seen
  double slant_range_m = 0.0;  ///< of it
  std::string scene_hash;
  radar::GroundMap map;
  radar::LayerStack labels;
  std::vector<SampleTarget> targets;
  double noise_sigma0 = 0.0;  ///< in each of VV, HH and HV
};

/// Scene and atlas made ready for the samples of one spec. Threads may make samples at once.
class SampleMaker {
 public:
  /// Throws Error when a file cannot be read, the atlas is of another scene, or the spec's ranges are impossible with
  /// them: elevations or frequency that were not baked, orders of bounces that these bakes do not tell, maps larger
  /// than the scene, a radar that would stand in the scene or over the map, or come there in a sequence, a range gate
  /// that is shut over every map.
  explicit SampleMaker(const DatasetSpec& spec);

  [[nodiscard]] const DatasetSpec& spec() const { return spec_; }
  [[nodiscard]] const scene::Scene& scene() const { return scene_; }
  [[nodiscard]] const std::string& scene_hash() const { return scene_hash_; }
  [[nodiscard]] const std::string& targets_hash() const { return targets_hash_; }
  /// SHA-256 of what the atlases say of themselves, the bounces' after the other; none at level of detail 0.
  [[nodiscard]] const std::vector<std::string>& atlas_hashes() const { return atlas_hashes_; }

  /// Sample number `index`, a pure function of spec and index. Uses the calling thread alone.
  ///
  /// Targets stand on the ground wherever the spec lets them and answer with what the radar sees of them along their
  /// own line of sight (simulate::part_seen). A box holds the target's size and the half-power widths of its response,
  /// where its range lays them.
  [[nodiscard]] Sample make(std::size_t index) const;

 private:
  void check_views() const;
  void check_gate() const;
  /// What `check_views` asks of the first frame, of the others of every sequence.
  void check_flights() const;
  void check_classes() const;
  void check_frame(const SamplePlan& plan) const;
  void check_radars() const;
  void check_materials(const Range& frequencies_hz) const;
  /// The image of the ground without any target; layers that tell bounces apart are added to `bounces`.
  [[nodiscard]] radar::RangeAzimuthImage ground_image(const radar::Radar& radar, const SamplePlan& plan,
                                                      std::vector<radar::Layer>& bounces) const;
  [[nodiscard]] radar::LayerStack labels(const radar::Radar& radar, const radar::GroundGrid& grid) const;
  /// What comes past hills, houses and crowns of the power of a point.
  using PartSeen = std::function<double(Vec3d point)>;
  [[nodiscard]] PartSeen part_seen_from(const radar::Radar& radar) const;
  /// Where the planned targets show, and what the radar sees of them.
  [[nodiscard]] std::vector<SampleTarget> targets_of(const SamplePlan& plan, const radar::Radar& radar,
                                                     const radar::GroundMap& map, const PartSeen& part_seen) const;
  /// σ0 of what is seen of the targets and of the scene's reflectors, which has no speckle; empty where that is
  /// nothing.
  [[nodiscard]] Array2D<radar::Channels> steady_sigma0(const std::vector<SampleTarget>& targets,
                                                       const PartSeen& part_seen, const radar::Radar& radar,
                                                       const radar::RangeAzimuthGrid& bins,
                                                       const radar::GroundGrid& grid) const;

  DatasetSpec spec_;
  scene::Scene scene_;  // without its point targets
  std::string scene_hash_, targets_hash_;
  std::vector<radar::Target> reflectors_;  // the scene's point targets
  radar::Rectangle centres_;
  std::optional<atlas::Atlas> atlas_;
  std::vector<std::string> atlas_hashes_;
  std::vector<atlas::Atlas> bounce_atlases_;  // of at most one bounce, at most two, …: as many as are asked for
  std::shared_ptr<const radar::ObstacleMap> obstacles_;  // of levels of detail from 1 on
  double tallest_m_ = 0.0;                               // of them
  double highest_m_ = 0.0;                               // of the terrain with them
  std::optional<trace::SceneGeometry> geometry_;         // of level of detail 0
};

}  // namespace sigmascape::dataset
