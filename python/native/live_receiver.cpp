#include "sigmascape/live/live_receiver.h"

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

using GroundOrScene = std::variant<const Held<live::LiveGround>*, std::shared_ptr<LoadedScene>>;

live::KeptGround kept_ground(const GroundOrScene& given) {
  if (const auto* const scene = std::get_if<std::shared_ptr<LoadedScene>>(&given)) {
    return live::GroundHeight([loaded = *scene](Vec2d place) { return loaded->scene().terrain.height_at(place); });
  }
  const auto* const ground = std::get<const Held<live::LiveGround>*>(given);
  return ground == nullptr ? live::KeptGround() : live::KeptGround(ground->here());
}

std::unique_ptr<Held<live::LiveReceiver>> made_receiver(const radar::RadarFile& radar, const GroundOrScene& ground,
                                                        const std::string& polarization, Threads threads) {
  // Python may change it while others have the GIL.
  const radar::Radar asked = radar.radar;
  const WithoutGil working;
  auto made =
      std::make_shared<live::LiveReceiver>(asked, polarization_from(polarization), kept_ground(ground), threads);
  return std::make_unique<Held<live::LiveReceiver>>("LiveReceiver", std::move(made));
}

/// What was heard and what holds it, which others that hear with the same receiver meanwhile may replace.
struct HeldPower {
  radar::RangeAzimuthGrid grid;
  std::shared_ptr<const std::vector<float>> signal_w;  ///< [beam][range]
};

/// The bins are the renderer's: nobody is to draw into them meanwhile.
HeldPower heard(live::LiveReceiver& receiver, const HeldFrame& held) {
  const std::scoped_lock turn(*held.turns);
  return {receiver.hear(held.frame).grid, receiver.signal()};
}

py::array hear(const py::object& self, const HeldFrame& held) {
  const auto& receiver = self.cast<const Held<live::LiveReceiver>&>();
  auto power = std::make_unique<HeldPower>(
      long_call([&] { return receiver.in_turn([&](live::LiveReceiver& here) { return heard(here, held); }); }));
  const float* const signal_w = power->signal_w->data();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(power->grid.azimuths),
                                 static_cast<py::ssize_t>(power->grid.ranges)};
  const py::capsule owner(power.get(), [](void* kept) { delete static_cast<HeldPower*>(kept); });
  (void)power.release();
  return array_view(signal_w, std::move(shape), owner, Access::ReadOnly);
}

}  // namespace

void add_live_receiver(py::module_& module) {
  py::class_<Held<live::LiveReceiver>>(
      module, "LiveReceiver",
      "What a radar hears of live frames, in watts at the antenna's terminals, of all beams or step by step of a "
      "scan:\n"
      "sigmascape.received_power for frames. Threads and processes share it as they do a LiveRenderer.")
      .def(
          py::init(&made_receiver), py::arg("radar"),
          py::arg("ground") = static_cast<const Held<live::LiveGround>*>(nullptr), py::kw_only(),
          py::arg("polarization") = "vv", py::arg("threads") = 0,
          "radar: of whose place and mode nothing is taken but the scan, an azimuth of which is counted from the\n"
          "frame's north as those of poses are. ground: that the bins lie on, which says from how far below the radar\n"
          "they answer; a Scene for frames of a LiveTracer. Only an antenna that is even in elevation does without.\n"
          "polarization: 'vv', 'hh', 'hv' or 'vh'. Raises Error for 'sum', and without ground\n"
          "for an antenna that tells elevations apart.")
      .def("hear", &hear, py::arg("frame"),
           "float32 [beam, range]: mean power of a compressed pulse with the beam's axis in the bin's middle, W;\n"
           "NaN in ranges outside the radar's gate and in azimuths that its scan never comes to. Only beams that were\n"
           "drawn since it heard last are heard anew, each from where the radar was then, and those beside them. The\n"
           "array shares the receiver's memory and changes with the next frame of as many beams and as many ranges\n"
           "that it hears. Raises Error for a frame after which its renderer has drawn another, and for a radar whose\n"
           "frequency is more than 1 % from the frame's.")
      .def_property_readonly(
          "noise_w", [](const Held<live::LiveReceiver>& held) { return held.here()->noise_w(); },
          "Mean power of the noise beside it, k T0 B F, W, the same in every bin.");
}

}  // namespace sigmascape::python
