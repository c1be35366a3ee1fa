#include "sigmascape/simulate/live_flight.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/render/detail_of_ground.h"
#include "sigmascape/simulate/frame_blend.h"

namespace sigmascape::simulate {
namespace {

LiveFlightSettings settled(LiveFlightSettings flight, const render::LiveGround& ground) {
  if (flight.frames_a_change < 1) {
    throw Error("live flight", fmt::format("is to change levels within {} frames", flight.frames_a_change),
                "give at least one");
  }
  flight.tracing.frequency_hz = ground.frequency_hz();
  flight.tracing.lattice_m = ground.description().patches.texel_m;
  return flight;
}

}  // namespace

render::DetailSettings settings_in_use(const render::DetailSettings& detail, bool is_traced) {
  render::DetailSettings settings = detail;
  const double longer = std::exp2(is_traced ? detail.hysteresis : -detail.hysteresis);
  settings.largest_traced_m2 *= longer * longer;
  settings.reach_per_cell /= longer;
  settings.pixels_per_triangle /= longer * longer;
  return settings;
}

LiveFlight::LiveFlight(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                       std::shared_ptr<render::LiveGround> ground, const render::LiveSettings& settings,
                       const LiveFlightSettings& flight)
    : ground_(std::move(ground)),
      flight_(settled(flight, *ground_)),
      tracer_(scene, geometry, settings, flight_.tracing),
      renderer_(ground_, settings) {
  const std::size_t bins = settings.beams * settings.ranges;
  if (settings.content == render::FrameContent::Amplitudes)
    amplitudes_m_.resize(4 * bins);
  else
    powers_m2_.resize(4 * bins);
}

const render::Frame& LiveFlight::render(const render::Pose& pose) {
  choose(pose);
  if (textured_share_ == 0.0) return tracer_.render(pose);
  if (textured_share_ == 1.0) return renderer_.render(pose);
  return blended(tracer_.render(pose), renderer_.render(pose));
}

void LiveFlight::choose(const render::Pose& pose) {
  const render::DetailQuestion question = render::with_ground(tracer_.question(pose), *ground_);
  // What is being left is as good as left: a change that has begun is gone on with.
  const render::DetailSettings detail = begun_ ? settings_in_use(flight_.detail, choice_.level == 0) : flight_.detail;
  choice_ = render::choose_detail(question, detail);
  const double wanted = choice_.level == 0 ? 0.0 : 1.0, step = begun_ ? 1.0 / flight_.frames_a_change : 1.0;
  textured_share_ =
      wanted > textured_share_ ? std::min(textured_share_ + step, wanted) : std::max(textured_share_ - step, wanted);
  // Thirty thirtieths are not quite one.
  if (std::abs(textured_share_ - wanted) < 0.5 * step) textured_share_ = wanted;
  begun_ = true;
}

const render::Frame& LiveFlight::blended(const render::Frame& traced, const render::Frame& textured) {
  frame_.grid = traced.grid;
  frame_.report = textured_share_ < 0.5 ? traced.report : textured.report;
  if (amplitudes_m_.empty()) {
    blend_powers(traced.powers_m2, textured.powers_m2, textured_share_, powers_m2_);
    frame_.powers_m2 = powers_m2_;
  } else {
    blend_amplitudes(traced.amplitudes_m, textured.amplitudes_m, textured_share_, amplitudes_m_);
    frame_.amplitudes_m = amplitudes_m_;
  }
  return frame_;
}

std::string LiveFlight::explained() const {
  std::string text = render::explained(choice_);
  if (textured_share_ > 0.0 && textured_share_ < 1.0) {
    text += fmt::format("  on the way there: {:.0f} % of the power is traced, the rest from textures\n",
                        100.0 * (1.0 - textured_share_));
  }
  return text;
}

}  // namespace sigmascape::simulate
