#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/receiver/targets_by_beam.h"
#include "sigmascape/simulate/live_tracer.h"
#include "sigmascape/simulate/target_blend.h"

namespace sigmascape::simulate {

struct LiveFlightSettings {
  /// Of traced frames. Frequency and lattice_m have no say: they are those of the atlas.
  LiveTraceSettings tracing = {};
  /// When to trace: render::choose_detail, by the rule that it names, the paper's if wanted. One way or the other it
  /// has to be right by `hysteresis`, in levels, before what is in use is left.
  render::DetailSettings detail = {};
  /// In so many frames traced ground gives way to textures, or they to it.
  int frames_a_change = 30;
};

/// What decides between tracing and textures for whoever does one of them now: while the scene is traced areas may be
/// larger and what things reach may be less than the settings say before tracing ends, while it is not they must be
/// smaller and more before it begins; by `hysteresis` in levels, which are powers of two of lengths. A pure function.
[[nodiscard]] render::DetailSettings settings_in_use(const render::DetailSettings& detail, bool is_traced);

/// Live frames along a flight path at whatever level of detail they need: traced (level 0, LiveTracer) where a small
/// area is looked at closely, from textures (levels from 1 on, live::LiveRenderer) elsewhere. Between the two no step
/// shows: one gives way to the other over some frames, each with its share of the power (simulate/frame_blend.h). While
/// only one is in use only that one is drawn, and costs. Poses that LiveTracer::can_trace says no to are shown from
/// textures at once, whatever the choice: below the scene's highest point nothing is traced.
///
/// For one caller at a time. Bytes do not depend on the number of threads.
class LiveFlight {
 public:
  /// Scene and geometry, on its terrain, must outlive the flight. Throws Error as LiveTracer and LiveRenderer do,
  /// for an atlas of another scene and for a change that takes no frame.
  LiveFlight(const scene::Scene& scene, const trace::SceneGeometry& geometry, std::shared_ptr<live::LiveGround> ground,
             const live::LiveSettings& settings, const LiveFlightSettings& flight = {});

  /// All beams, valid until the next call. Throws Error for a pose that is nowhere, where it is traced for a bin that
  /// is too bright for its sums, and where it is shown from textures as LiveRenderer does.
  const live::Frame& render(const live::Pose& pose);
  /// Beams first … first + count − 1 anew, the others as they were: one step of a scanning antenna, by LiveTracer::scan
  /// and LiveRenderer::scan. Each step goes on with a change between levels as a frame does, so that it passes over the
  /// beams that come next, and a turn later all of the picture is of one level. Throws Error as live::check_step does
  /// and as `render` does.
  const live::Frame& scan(const live::Pose& pose, std::size_t first_beam, std::size_t count);

  /// What the last pose asked for, and why: level 0 to be traced. What is shown follows over some frames, or stays
  /// textures where the pose cannot be traced.
  [[nodiscard]] const render::DetailChoice& choice() const { return course_.choice; }
  /// Part of the last frame's power, or that of the last step's beams, that comes from textures: 0 where it is traced,
  /// 1 from textures.
  [[nodiscard]] double textured_share() const { return course_.textured_share; }
  /// A few lines for people: render::explained, and what is shown meanwhile.
  [[nodiscard]] std::string explained() const;

 private:
  /// What the last pose asked for, and how far it is shown.
  struct Course {
    render::DetailChoice choice;
    double textured_share = 0.0;
    bool has_begun = false, can_trace = true;
  };
  [[nodiscard]] Course course_to(const live::Pose& pose) const;
  /// Goes on to a pose by drawing what it asks for; where that is refused the course is what it was.
  template <typename Draw>
  void go_on(const live::Pose& pose, const Draw& draw);
  /// Numbers of a frame: some beams', or all.
  struct Part {
    std::size_t first = 0, count = 0;
  };
  /// Both with their shares.
  void blend(const live::Frame& traced, const live::Frame& textured, Part part);
  void copy(const live::Frame& shown, Part part);
  /// Their bins change, and hold what was shown then.
  void begin_beams(Part part);
  void end_beams(const live::Frame& shown);
  /// Takes the targets of what was shown over those beams.
  void copy_targets(const live::Frame& shown, Part part);
  /// Takes what was shown last, wherever it lies, for what the beams of a step are to be put into.
  void keep();

  std::shared_ptr<live::LiveGround> ground_;
  LiveFlightSettings flight_;
  LiveTracer tracer_;
  live::LiveRenderer renderer_;
  std::size_t beams_, numbers_a_beam_;
  Course course_;
  // What was shown last, unless it lies where the tracer or the renderer has it.
  std::vector<float> powers_m2_;
  std::vector<std::complex<float>> amplitudes_m_;
  live::DrawnBeams drawn_;
  receiver::TargetsByBeam targets_;
  TargetBlend target_blend_;
  live::Frame frame_;
};

}  // namespace sigmascape::simulate
