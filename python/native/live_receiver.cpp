#include "sigmascape/render/live_receiver.h"

#include <memory>
#include <mutex>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "array_view.h"
#include "gil.h"
#include "held.h"
#include "held_frame.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "polarization.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/radar/radar_file.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

struct FrameReceiver {
  render::LiveReceiver receiver;
  std::uint64_t heard = 0;  ///< number of the last frame that it has heard; 0: none
};

using GroundOrScene = std::variant<const Held<render::LiveGround>*, std::shared_ptr<LoadedScene>>;

render::KeptGround kept_ground(const GroundOrScene& given) {
  if (const auto* const scene = std::get_if<std::shared_ptr<LoadedScene>>(&given)) {
    return render::GroundHeight([loaded = *scene](Vec2d place) { return loaded->scene().terrain.height_at(place); });
  }
  const auto* const ground = std::get<const Held<render::LiveGround>*>(given);
  return ground == nullptr ? render::KeptGround() : render::KeptGround(ground->here());
}

std::unique_ptr<Held<FrameReceiver>> made_receiver(const radar::RadarFile& radar, const GroundOrScene& ground,
                                                   const std::string& polarization, Threads threads) {
  // Python may change it while others have the GIL.
  const radar::Radar asked = radar.radar;
  const WithoutGil working;
  std::shared_ptr<FrameReceiver> made(
      new FrameReceiver{.receiver = {asked, polarization_from(polarization), kept_ground(ground), threads}});
  return std::make_unique<Held<FrameReceiver>>("LiveReceiver", std::move(made));
}

/// What was heard and what holds it, which others that hear with the same receiver meanwhile may replace.
struct HeldPower {
  radar::RangeAzimuthGrid grid;
  std::shared_ptr<const std::vector<float>> signal_w;  ///< [beam][range]
};

/// The bins are the renderer's: nobody is to draw into them meanwhile.
HeldPower heard(FrameReceiver& live, const HeldFrame& held) {
  const std::scoped_lock turn(*held.turns);
  if (held.number != *held.newest) {
    throw Error("LiveReceiver", "cannot hear a frame whose bins hold a later one of its renderer",
                "hear each frame before the next is drawn");
  }
  const bool is_next = live.heard != 0 && live.heard == held.before;
  live.heard = 0;
  const render::HeardPower& power = is_next
                                        ? live.receiver.hear(held.frame, held.pose, held.step.first, held.step.count)
                                        : live.receiver.hear(held.frame, held.pose);
  live.heard = held.number;
  return {power.grid, live.receiver.signal()};
}

py::array hear(const py::object& self, const HeldFrame& held) {
  const auto& receiver = self.cast<const Held<FrameReceiver>&>();
  auto power = std::make_unique<HeldPower>(
      long_call([&] { return receiver.in_turn([&](FrameReceiver& live) { return heard(live, held); }); }));
  const float* const signal_w = power->signal_w->data();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(power->grid.azimuths),
                                 static_cast<py::ssize_t>(power->grid.ranges)};
  const py::capsule owner(power.get(), [](void* kept) { delete static_cast<HeldPower*>(kept); });
  (void)power.release();
  return array_view(signal_w, std::move(shape), owner, Access::ReadOnly);
}

}  // namespace

void add_live_receiver(py::module_& module) {
  py::class_<Held<FrameReceiver>>(
      module, "LiveReceiver",
      "What a radar hears of live frames, in watts at the antenna's terminals, of all beams or step by step of a "
      "scan:\n"
      "sigmascape.received_power for frames. Threads and processes share it as they do a LiveRenderer.")
      .def(
          py::init(&made_receiver), py::arg("radar"),
          py::arg("ground") = static_cast<const Held<render::LiveGround>*>(nullptr), py::kw_only(),
          py::arg("polarization") = "vv", py::arg("threads") = 0,
          "radar: of whose place and mode nothing is taken but the scan. ground: that the bins lie on, which says "
          "from\n"
          "how far below the radar they answer; a Scene for frames of a LiveTracer. Only an antenna that is even in\n"
          "elevation does without. polarization: 'vv', 'hh', 'hv' or 'vh'. Raises Error for 'sum', and without ground\n"
          "for an antenna that tells elevations apart.")
      .def(
          "hear", &hear, py::arg("frame"),
          "float32 [beam, range]: mean power of a compressed pulse with the beam's axis in the bin's middle, W;\n"
          "NaN in ranges outside the radar's gate and in azimuths that its scan never comes to. Of a step of a\n"
          "scan only what it changes is heard anew, if the frame before it was heard too; else all beams are,\n"
          "from where the radar is now: hear every step. The array shares the receiver's memory and changes with\n"
          "the next frame of as many beams and as many ranges that it hears. Raises Error for a frame after which its\n"
          "renderer has drawn another, and for a radar whose frequency is more than 1 % from the frame's.")
      .def_property_readonly(
          "noise_w", [](const Held<FrameReceiver>& held) { return held.here()->receiver.noise_w(); },
          "Mean power of the noise beside it, k T0 B F, W, the same in every bin.");
}

}  // namespace sigmascape::python
