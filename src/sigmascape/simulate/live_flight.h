#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "sigmascape/render/live_renderer.h"
#include "sigmascape/simulate/live_tracer.h"

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
/// area is looked at closely, from textures (levels from 1 on, render::LiveRenderer) elsewhere. Between the two no step
/// shows: one gives way to the other over some frames, each with its share of the power (simulate/frame_blend.h). While
/// only one is in use only that one is drawn, and costs.
///
/// For one caller at a time. Bytes do not depend on the number of threads.
class LiveFlight {
 public:
  /// Scene and geometry, on its terrain, must outlive the flight; the atlas is one of that scene. Throws Error as
  /// LiveTracer and LiveRenderer do, and for a change that takes no frame.
  LiveFlight(const scene::Scene& scene, const trace::SceneGeometry& geometry,
             std::shared_ptr<render::LiveGround> ground, const render::LiveSettings& settings,
             const LiveFlightSettings& flight = {});

  /// All beams, valid until the next call. Throws Error as LiveTracer::render does where it is traced.
  const render::Frame& render(const render::Pose& pose);

  /// What the last pose asked for, and why: level 0 to be traced. What is shown follows over some frames.
  [[nodiscard]] const render::DetailChoice& choice() const { return choice_; }
  /// Part of the last frame's power that comes from textures: 0 of a traced frame, 1 of one from textures.
  [[nodiscard]] double textured_share() const { return textured_share_; }
  /// A few lines for people: render::explained, and what is shown meanwhile.
  [[nodiscard]] std::string explained() const;

 private:
  void choose(const render::Pose& pose);
  const render::Frame& blended(const render::Frame& traced, const render::Frame& textured);

  std::shared_ptr<render::LiveGround> ground_;
  LiveFlightSettings flight_;
  LiveTracer tracer_;
  render::LiveRenderer renderer_;
  render::DetailChoice choice_;
  double textured_share_ = 0.0;
  bool begun_ = false;
  std::vector<float> powers_m2_;  // of frames of both
  std::vector<std::complex<float>> amplitudes_m_;
  render::Frame frame_;
};

}  // namespace sigmascape::simulate
