#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sigmascape/live/frame_bins.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/shadow_box.h"
#include "sigmascape/receiver/target_frame.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::simulate {

class TracedGround;

/// What a traced frame needs to know besides its bins.
struct LiveTraceSettings {
  double frequency_hz = 10e9;
  /// Rays a lattice cell that each call of `render` or `scan` adds, in whole passes of two.
  std::uint32_t rays_per_cell = 8;
  int max_bounces = 8;  ///< 1 to trace::most_bounces
  /// Side of the finest lattice cells, doubled for a frame until its bins tell cells apart no more (cells_per_bin).
  /// After wider bins finer cells wait until they are right by a quarter of a doubling, for all scatterers change then.
  /// With the texel of an atlas a frame's cells are those of live::LiveRenderer over it and hold the same scatterers.
  /// Bins finer than the finest cells share scatterers.
  double lattice_m = 0.25;
  /// Lattice cells of ground that are traced at a time, at most: a frame that needs more is refused, of the steps of a
  /// scan the oldest are forgotten. Of each 13 bytes are kept, and for amplitudes 48 more: this many take a fifth of a
  /// gigabyte, or one. Amplitudes take 48 bytes as well for each cell beside the scene, under the bins, in every
  /// square of 8 × 8 that an echo lands in: next to none seen flatly, several hundred metres all round where a radar
  /// looks straight down on tall things. While rays are laid out past the highest point so flatly that four times as
  /// many are aimed at, it may be two gigabytes more.
  double most_cells = 0x1p24;
};

/// Level of detail 0 of live frames: the whole scene, path-traced, in the bins and by the poses of
/// live::LiveRenderer.
///
/// While pose and shadows of targets stay as they are each call adds rays to those before, so that the picture becomes
/// clearer; FrameReport says how many there are and how well they know the power. Another pose begins anew, with rays
/// that are keyed on the ground: what is left of their noise does not flicker. Bytes depend neither on the number of
/// threads nor on how rays are spread over calls, and on poses before in that alone which cells those left.
///
/// Speckle is that of LiveRenderer: one scatterer a cell of the lattice, whose power is that of all echoes that land
/// there for one who knows the ground alone. docs/decisions/0099-speckle-of-traced-frames.md. Across, a scatterer is
/// shared between two beams, however many its cell is wide: where beams are narrower than cells, I/Q is spots with dark
/// beams between them, right in the mean alone. LiveRenderer lets a cell answer in all beams over it.
///
/// The Earth curves away from the middle of the area that the bins look at; about it ground is taken to be flat, which
/// 2 km from there is wrong by a quarter of a metre. Ground outside the scene's extent does not answer. Point targets
/// of the scene answer where the pose names them (`targets_of`), like all others, wherever the scene does not hide
/// them.
///
/// Scene and geometry, on its terrain, must outlive the tracer. For one caller at a time. Time goes with the ground
/// that the bins look at, whatever their number; memory with both (LiveTraceSettings::most_cells): a bin of power takes
/// 108 bytes, one of amplitudes 124.
class LiveTracer {
 public:
  /// Throws Error for settings from which no frame can come. `settings.visibility` has no say.
  LiveTracer(const scene::Scene& scene, const trace::SceneGeometry& geometry, const live::LiveSettings& settings,
             const LiveTraceSettings& tracing = {});
  ~LiveTracer();

  /// Whether the radar stands above all of the scene and its bins look at no more ground than may be traced at a time,
  /// nor so flatly past the highest point that rays would have to be aimed at several times as much behind it; always
  /// where they look at none. With speckle the ground of cells counts that reach into the outermost beams from beside.
  /// Throws Error for a pose that is nowhere.
  [[nodiscard]] bool can_trace(const live::Pose& pose) const;

  /// Throws Error for what can_trace says no to, and for a bin that is too bright for its sums.
  const live::Frame& render(const live::Pose& pose);
  /// Beams first … first + count − 1 anew, the others as they were: one step of a scanning antenna, traced as a frame
  /// of those beams alone, whose report it has. Rays are added to those before where the pose is the same and so are
  /// the beams, whichever others were asked for in between; beams that overlap with others end those, and steps end the
  /// oldest ones when all together look at more ground than one frame may.
  ///
  /// At one pose a turn in steps holds the bytes of a whole frame as far as echoes come straight back. Of paths of
  /// several bounces a step has those that begin no farther beside it than trace::MultibounceReach says, as every frame
  /// has, and with rays that are weighted by what else is traced: a turn lacks a few thousandths of the power, and its
  /// noise is its own. Throws Error as live::check_step does and as `render` does.
  const live::Frame& scan(const live::Pose& pose, std::size_t first_beam, std::size_t count);

  /// What render::choose_detail is to be asked for such a frame, of this scene; what an atlas offers instead is the
  /// caller's to add (live::with_ground). Throws Error for a pose that is nowhere.
  [[nodiscard]] render::DetailQuestion question(const live::Pose& pose) const;

 private:
  struct Beams {
    std::size_t first = 0, count = 0;

    [[nodiscard]] bool operator==(const Beams&) const = default;
    [[nodiscard]] bool overlap(const Beams& other) const {
      return first < other.first + other.count && other.first < first + count;
    }
  };
  /// Where the bins of a pose look.
  struct Look {
    Vec3d radar;  ///< from where lines of sight are straight
    double near_m = 0.0, far_m = 0.0;
    live::FrameReach sharing;     ///< where ground lies that has a share in the bins
    live::FrameReach halfway_up;  ///< where bins lie on ground of one height, between the lowest and the highest
    radar::Rectangle ground;      ///< of the scene, under all beams; nothing when its east lies west
  };
  /// Beams that are traced together, call after call.
  struct Step {
    Beams beams;
    std::unique_ptr<TracedGround> ground;  ///< none where they see nothing of the scene
    double cells = 0.0;                    ///< of the lattice, in it
  };

  [[nodiscard]] Look look_of(const live::Pose& pose) const;
  [[nodiscard]] Look look_from(Vec3d radar, const live::Pose& pose) const;
  /// Of the scene what lies under beams and so many beside them.
  [[nodiscard]] radar::Rectangle ground_under(const Look& look, const live::Pose& pose, Beams beams,
                                              double rim_beams) const;
  /// The same as far as it is traced for them.
  [[nodiscard]] radar::Rectangle ground_traced(const Look& look, const live::Pose& pose, Beams beams) const;
  /// Whether power is kept by cells of the lattice, as speckle needs it.
  [[nodiscard]] bool keeps_cells() const;
  /// TracedView::rim_beams.
  [[nodiscard]] double rim_beams(const Look& look, const live::Pose& pose) const;
  [[nodiscard]] int lattice_level(const Look& look) const;
  [[nodiscard]] double lattice_cell_m(const Look& look) const;
  [[nodiscard]] double cells_in(const radar::Rectangle& area, const Look& look) const;
  [[nodiscard]] double cells_aimed_at(const radar::Rectangle& area, const Look& look) const;
  /// How many beams a cell of the lattice may be wide.
  [[nodiscard]] double widest_cell_beams(const Look& look, const live::Pose& pose) const;
  void begin(const live::Pose& pose);
  /// That of these beams, with what they have been brought since the pose is what it is.
  [[nodiscard]] TracedGround* ground_of(const live::Pose& pose, Beams beams);
  [[nodiscard]] std::unique_ptr<TracedGround> made_ground(const live::Pose& pose, Beams beams) const;
  void show_ground(const live::Pose& pose, const TracedGround& ground);
  void add_targets(const live::Pose& pose, Beams beams);

  const scene::Scene& scene_;
  const trace::SceneGeometry& geometry_;
  live::LiveSettings settings_;
  LiveTraceSettings tracing_;
  std::vector<scatter::SurfaceModel> surfaces_;
  radar::ScattererLattice lattice_;
  receiver::TargetFrame targets_;
  double lowest_m_, highest_m_;  // of the terrain
  double tallest_m_;             // of what stands on it
  radar::Rectangle occupied_;    // by the scene with all that stands there
  double triangles_per_m2_;      // of all meshes

  // Of the pose in hand.
  std::optional<Vec3d> position_;
  radar::RangeAzimuthGrid grid_;
  Look look_;
  std::optional<int> lattice_level_;
  std::vector<radar::ShadowBox> boxes_;
  std::vector<Step> steps_;

  live::DrawnBeams drawn_;
  live::FrameBins bins_;
  live::Frame frame_;
};

}  // namespace sigmascape::simulate
