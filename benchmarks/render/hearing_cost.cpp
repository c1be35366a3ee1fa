#include "hearing_cost.h"

#include <algorithm>
#include <cmath>

#include "figures.h"
#include "frame_cost.h"

#include "sigmascape/live/drawn_beams.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/live/live_receiver.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::bench {
namespace {

constexpr auto polarization = radar::Polarization::VV;
constexpr std::size_t beams_heard = 8;

/// Lowers `least` to what `work` takes.
template <typename Work>
void take_least(double& least, Work&& work) {
  const double start = processor_seconds();
  work();
  least = std::min(least, processor_seconds() - start);
}

void prove_alike(const live::HeardPower& heard, const receiver::ReceivedPower& expected) {
  double difference = 0.0, sum = 0.0;
  for (std::size_t beam = 0; beam < heard.grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < heard.grid.ranges; ++range) {
      const auto here = static_cast<double>(heard.signal_w[beam * heard.grid.ranges + range]);
      const auto there = static_cast<double>(expected.signal_w(beam, range));
      difference += std::abs(here - there);
      sum += there;
    }
  }
  prove(sum > 0.0 && difference < 1e-3 * sum, "watts heard live are those of the whole image");
}

}  // namespace

HearingCost hearing_cost(const std::shared_ptr<live::LiveGround>& ground, const radar::Radar& radar,
                         const live::LiveSettings& settings, const live::Pose& pose, int repetitions) {
  live::LiveRenderer renderer(ground, settings);
  live::Frame frame = settled(renderer, *ground, pose);
  const live::GroundHeight below = live::ground_below(frame, *ground);
  HearingCost cost;
  receiver::ReceivedPower expected;
  for (int run = 0; run < repetitions; ++run) {
    take_least(cost.image,
               [&] { expected = receiver::received_power(radar, live::image_of(frame, radar, below), polarization); });
  }
  live::LiveReceiver receiver(radar, polarization, ground, 1);
  cost.first = 1e30;
  take_least(cost.first, [&] { receiver.hear(frame); });
  prove_alike(receiver.hear(frame), expected);
  // What the bins hold costs the same every time: that they were drawn again is said alone.
  live::DrawnBeams drawn(frame.grid.azimuths);
  Vec3d place = pose.position;
  const auto hear = [&](double& least, std::size_t first_beam, std::size_t count) {
    drawn.begin(first_beam, count);
    frame.drawing = drawn.end(place);
    frame.beams = drawn.all();
    take_least(least, [&] { receiver.hear(frame); });
  };
  for (int run = 0; run < repetitions; ++run) {
    hear(cost.frame, 0, frame.grid.azimuths);
    hear(cost.step, beams_heard, beams_heard);
    place.x += 1.0;
    hear(cost.moved_step, beams_heard, beams_heard);
    hear(cost.moved_frame, 0, frame.grid.azimuths);
  }
  return cost;
}

}  // namespace sigmascape::bench
