#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include "held.h"
#include "held_frame.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "origin_words.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {

using Triple = std::array<double, 3>;
using Beams = Whole<"beams", std::uint32_t, 1>;
using Ranges = Whole<"ranges", std::uint32_t, 1>;
using RaysPerCell = Whole<"rays_per_cell", std::uint32_t, 1>;
using FirstBeam = Whole<"first_beam", std::uint32_t>;
using BeamCount = Whole<"count", std::uint32_t, 1>;
using Pulse = Whole<"pulse", std::uint64_t>;

/// What Python holds of a class that draws live frames, `Drawer`, and what that draws on.
template <typename Drawer>
struct DrawnLive {
  std::uint64_t seed;
  Words words;
  geo::LocalFrame frame;
  std::shared_ptr<LoadedScene> scene;  ///< whose point targets answer besides those that are set; null: none
  simulate::TargetGround ground;
  Drawer drawer;
  std::vector<radar::Target> targets;

  void set_targets(const std::vector<radar::TargetSource>& given) {
    targets = simulate::all_targets(scene ? &scene->scene() : nullptr, given, frame, ground, seed);
  }
};

inline live::Pose pose_from(const Triple& position_m, double first_azimuth_rad, double first_range_m,
                            const Triple& velocity_mps = {}, const radar::Moment& moment = {}) {
  return {.position = {position_m[0], position_m[1], position_m[2]},
          .first_azimuth_rad = first_azimuth_rad,
          .first_range_m = first_range_m,
          .velocity_mps = {velocity_mps[0], velocity_mps[1], velocity_mps[2]},
          .moment = moment};
}

inline live::LiveSettings settings_from(const std::string& content, std::size_t beams, std::size_t ranges,
                                        double beam_step_rad, double range_step_m, double cells_per_bin,
                                        std::uint64_t seed, unsigned threads, double refraction) {
  if (content != "amplitudes" && content != "powers")
    throw Error("content", "is '" + content + "'", "give 'amplitudes' or 'powers'");
  return {.content = content == "powers" ? live::FrameContent::Powers : live::FrameContent::Amplitudes,
          .beams = beams,
          .ranges = ranges,
          .beam_step_rad = beam_step_rad,
          .range_step_m = range_step_m,
          .cells_per_bin = cells_per_bin,
          .seed = seed,
          .threads = threads,
          .refraction = refraction};
}

/// What `draw` makes of the pose with the drawer behind `self`, for which others wait their turn.
template <typename Drawer, typename Draw>
HeldFrame drawn(const pybind11::object& self, const live::Pose& pose, const Draw& draw) {
  const auto& held = self.cast<const Held<DrawnLive<Drawer>>&>();
  // A copy of what is told about the bins, taken before the next caller's frame is.
  HeldFrame frame = long_call([&] {
    return held.in_turn([&](DrawnLive<Drawer>& live) {
      live::Pose with_targets = pose;
      with_targets.targets = live.targets;
      return HeldFrame{
          .frame = draw(live, with_targets), .pose = pose, .renderer = {}, .turns = &held.turns(), .words = live.words};
    });
  });
  frame.renderer = self;
  return frame;
}

/// Binds `render`, `scan` and `set_targets`, which all of these classes have. The words say what is particular to one.
template <typename Drawer>
void bind_drawing(pybind11::class_<Held<DrawnLive<Drawer>>>& binding, const char* of_render, const char* of_scan) {
  namespace py = pybind11;
  const py::kw_only by_keyword;
  const py::arg position("position_m"), azimuth("first_azimuth_rad"), range("first_range_m");
  const auto velocity = py::arg("velocity_mps") = Triple{};
  const auto time = py::arg("time_s") = 0.0;
  const auto dwell = py::arg("dwell") = std::uint64_t{0};
  const auto pulse = py::arg("pulse") = std::uint64_t{0};
  binding.def(
      "render",
      [](const py::object& self, const Triple& position_m, double first_azimuth_rad, double first_range_m,
         const Triple& velocity_mps, double time_s, Dwell dwell_number, Pulse pulse_number) {
        return drawn<Drawer>(
            self,
            pose_from(position_m, first_azimuth_rad, first_range_m, velocity_mps, {time_s, dwell_number, pulse_number}),
            [](auto& live, const live::Pose& pose) { return live.drawer.render(pose); });
      },
      position, by_keyword, azimuth, range, velocity, time, dwell, pulse, of_render);
  binding.def(
      "scan",
      [](const py::object& self, const Triple& position_m, double first_azimuth_rad, double first_range_m,
         FirstBeam first_beam, BeamCount count, const Triple& velocity_mps, double time_s, Dwell dwell_number,
         Pulse pulse_number) {
        return drawn<Drawer>(
            self,
            pose_from(position_m, first_azimuth_rad, first_range_m, velocity_mps, {time_s, dwell_number, pulse_number}),
            [&](auto& live, const live::Pose& pose) { return live.drawer.scan(pose, first_beam, count); });
      },
      position, by_keyword, azimuth, range, py::arg("first_beam"), py::arg("count"), velocity, time, dwell, pulse,
      of_scan);
  binding.def(
      "set_targets",
      [](const Held<DrawnLive<Drawer>>& held, const std::vector<radar::TargetSource>& targets) {
        long_call([&] { held.in_turn([&](DrawnLive<Drawer>& live) { live.set_targets(targets); }); });
      },
      py::arg("targets"),
      "The Targets of all frames from now on, in place of those set before. They stand on the finest terrain that\n"
      "there is; time_s of a frame says where those that move are, dwell and pulse how those fade that fluctuate.\n"
      "Point targets of the scene answer besides, where frames are drawn from a Scene.");
}

}  // namespace sigmascape::python
