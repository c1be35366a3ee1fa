#include "sigmascape/simulate/live_flight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/live/detail_of_ground.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/frame_blend.h"

namespace sigmascape::simulate {
namespace {

LiveFlightSettings settled(LiveFlightSettings flight, const scene::Scene& scene, const live::LiveGround& ground) {
  if (ground.description().scene_hash != scene::scene_hash(scene)) {
    throw Error("live flight", fmt::format("is over an atlas that was baked from another scene than '{}'", scene.name),
                "bake this scene, or give the scene that the atlas was made from");
  }
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
                       std::shared_ptr<live::LiveGround> ground, const live::LiveSettings& settings,
                       const LiveFlightSettings& flight)
    : ground_(std::move(ground)),
      flight_(settled(flight, scene, *ground_)),
      tracer_(scene, geometry, settings, flight_.tracing),
      renderer_(ground_, settings),
      beams_(settings.beams),
      numbers_a_beam_(4 * settings.ranges),
      drawn_(settings.beams),
      targets_(settings.ranges) {
  frame_.frequency_hz = ground_->frequency_hz();
  frame_.earth = {.refraction = settings.refraction};
  frame_.beams = drawn_.all();
  if (settings.content == live::FrameContent::Amplitudes)
    amplitudes_m_.resize(beams_ * numbers_a_beam_);
  else
    powers_m2_.resize(beams_ * numbers_a_beam_);
}

template <typename Draw>
void LiveFlight::go_on(const live::Pose& pose, const Draw& draw) {
  const Course before = std::exchange(course_, course_to(pose));
  try {
    draw();
  } catch (...) {
    course_ = before;
    throw;
  }
}

const live::Frame& LiveFlight::render(const live::Pose& pose) {
  go_on(pose, [&] {
    if (course_.textured_share == 0.0) {
      frame_ = tracer_.render(pose);
    } else if (course_.textured_share == 1.0) {
      frame_ = renderer_.render(pose);
    } else {
      // Either may refuse, and has the other's frame then if the last one lies there.
      keep();
      const live::Frame& textured = renderer_.render(pose);
      blend(tracer_.render(pose), textured, {0, beams_ * numbers_a_beam_});
    }
  });
  return frame_;
}

const live::Frame& LiveFlight::scan(const live::Pose& pose, std::size_t first_beam, std::size_t count) {
  live::check_step(first_beam, count, beams_);
  count = std::min(count, beams_ - first_beam);
  const Part part{first_beam * numbers_a_beam_, count * numbers_a_beam_};
  go_on(pose, [&] {
    keep();
    if (course_.textured_share == 0.0) {
      copy(tracer_.scan(pose, first_beam, count), part);
    } else if (course_.textured_share == 1.0) {
      copy(renderer_.scan(pose, first_beam, count), part);
    } else {
      const live::Frame& textured = renderer_.scan(pose, first_beam, count);
      blend(tracer_.scan(pose, first_beam, count), textured, part);
    }
  });
  return frame_;
}

LiveFlight::Course LiveFlight::course_to(const live::Pose& pose) const {
  const render::DetailQuestion question = live::with_ground(tracer_.question(pose), *ground_);
  // What is being left is as good as left: a change that has begun is gone on with.
  const render::DetailSettings detail =
      course_.has_begun ? settings_in_use(flight_.detail, course_.choice.level == 0) : flight_.detail;
  Course course{.choice = render::choose_detail(question, detail),
                .textured_share = course_.textured_share,
                .has_begun = true,
                .can_trace = tracer_.can_trace(pose)};
  const double wanted = course.choice.level == 0 ? 0.0 : 1.0,
               step = course_.has_begun ? 1.0 / flight_.frames_a_change : 1.0;
  double& share = course.textured_share;
  share = wanted > share ? std::min(share + step, wanted) : std::max(share - step, wanted);
  // Thirty thirtieths are not quite one.
  if (std::abs(share - wanted) < 0.5 * step) share = wanted;
  // What cannot be traced gives way at once: there is nothing to share with.
  if (!course.can_trace) share = 1.0;
  return course;
}

void LiveFlight::blend(const live::Frame& traced, const live::Frame& textured, Part part) {
  begin_beams(part);
  frame_.grid = traced.grid;
  frame_.report = course_.textured_share < 0.5 ? traced.report : textured.report;
  const auto& [first, count] = part;
  if (amplitudes_m_.empty()) {
    blend_powers(traced.powers_m2.subspan(first, count), textured.powers_m2.subspan(first, count),
                 course_.textured_share, std::span(powers_m2_).subspan(first, count));
    frame_.powers_m2 = powers_m2_;
  } else {
    blend_amplitudes(traced.amplitudes_m.subspan(first, count), textured.amplitudes_m.subspan(first, count),
                     course_.textured_share, std::span(amplitudes_m_).subspan(first, count));
    frame_.amplitudes_m = amplitudes_m_;
  }
  target_blend_.blend(traced, textured, course_.textured_share, first / numbers_a_beam_, count / numbers_a_beam_,
                      targets_);
  frame_.targets = targets_.all();
  // Which was drawn after the other.
  end_beams(traced);
}

void LiveFlight::copy_targets(const live::Frame& shown, Part part) {
  const std::size_t first_beam = part.first / numbers_a_beam_, count = part.count / numbers_a_beam_;
  const auto [echoes, bins] = receiver::of_beams(shown.targets, first_beam, count, numbers_a_beam_ / 4);
  const receiver::TargetsByBeam::Room room = targets_.renewed(first_beam, count, echoes.size(), bins.size());
  std::ranges::copy(echoes, room.echoes.begin());
  std::ranges::copy(bins, room.bins.begin());
  frame_.targets = targets_.all();
}

void LiveFlight::copy(const live::Frame& shown, Part part) {
  begin_beams(part);
  frame_.grid = shown.grid;
  frame_.report = shown.report;
  const auto first = static_cast<std::ptrdiff_t>(part.first);
  if (amplitudes_m_.empty())
    std::ranges::copy(shown.powers_m2.subspan(part.first, part.count), powers_m2_.begin() + first);
  else
    std::ranges::copy(shown.amplitudes_m.subspan(part.first, part.count), amplitudes_m_.begin() + first);
  copy_targets(shown, part);
  end_beams(shown);
}

void LiveFlight::begin_beams(Part part) {
  drawn_.begin(part.first / numbers_a_beam_, part.count / numbers_a_beam_);
}

void LiveFlight::end_beams(const live::Frame& shown) {
  drawn_.end_as_in(shown.beams);
  frame_.beams = drawn_.all();
  frame_.drawing = shown.drawing;
}

void LiveFlight::keep() {
  const bool holds_powers = amplitudes_m_.empty();
  const bool is_kept =
      holds_powers ? frame_.powers_m2.data() == powers_m2_.data() : frame_.amplitudes_m.data() == amplitudes_m_.data();
  if (is_kept) return;
  if (holds_powers) {
    std::ranges::copy(frame_.powers_m2, powers_m2_.begin());
    frame_.powers_m2 = powers_m2_;
  } else {
    std::ranges::copy(frame_.amplitudes_m, amplitudes_m_.begin());
    frame_.amplitudes_m = amplitudes_m_;
  }
  const Part all{0, beams_ * numbers_a_beam_};
  copy_targets(frame_, all);
  // Nothing was shown yet where they lie here.
  if (frame_.beams.data() == drawn_.all().data()) return;
  begin_beams(all);
  end_beams(frame_);
}

std::string LiveFlight::explained() const {
  std::string text = render::explained(course_.choice);
  if (!course_.can_trace && course_.choice.level == 0) {
    text +=
        "  from textures all the same: the radar does not stand above all of the scene, or looks at more of it than "
        "may be traced\n";
  }
  if (course_.textured_share > 0.0 && course_.textured_share < 1.0) {
    text += fmt::format("  on the way there: {:.0f} % of the power is traced, the rest from textures\n",
                        100.0 * (1.0 - course_.textured_share));
  }
  return text;
}

}  // namespace sigmascape::simulate
