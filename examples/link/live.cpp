// Renders one frame of an atlas and prints its mean power: what a program that links the library does.
//
//   live ATLAS EAST NORTH     the atlas that `sigmascape bake` wrote, and the place to look at, metres of its frame

#include <cstdlib>
#include <exception>
#include <iostream>

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/radar.h"

namespace {

void render_once(const char* atlas, sigmascape::Vec2d place) {
  using namespace sigmascape::live;
  const auto ground = LiveGround::open(atlas, 10e9);
  const sigmascape::Vec3d target{place.x, place.y, ground->terrain().height_at(place)};
  const LiveSettings settings{.beams = 64, .ranges = 64, .beam_step_rad = 4.0 / 5000.0, .range_step_m = 4.0};
  LiveRenderer renderer(ground, settings);

  const double south_rad = 3.14159265, elevation_rad = 0.245, slant_range_m = 5154.0;
  // The renderer's Earth is round; aimed over a flat one, a radar far away would look past the target.
  const sigmascape::radar::CurvedEarth earth{.refraction = settings.refraction};
  const Pose pose{
      .position = sigmascape::radar::position_seeing(target, south_rad, elevation_rad, slant_range_m, earth),
      .first_azimuth_rad = -0.5 * static_cast<double>(settings.beams) * settings.beam_step_rad,
      .first_range_m = slant_range_m - 0.5 * static_cast<double>(settings.ranges) * settings.range_step_m};
  renderer.render(pose);
  // A simulator would go on with what is there and have the rest a frame later.
  ground->wait_until_loaded();
  const Frame& frame = renderer.render(pose);

  double power = 0.0;
  for (std::size_t bin = 0; bin < settings.beams * settings.ranges; ++bin) {
    power += std::norm(frame.amplitudes_m[bin * 4]);
  }
  std::cout << frame.report.cells << " cells, " << frame.report.lit << " lit, mean cross-section of a bin in VV "
            << power / static_cast<double>(settings.beams * settings.ranges) << " m2\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: " << argv[0] << " ATLAS EAST NORTH\n";
    return 2;
  }
  try {
    render_once(argv[1], {std::atof(argv[2]), std::atof(argv[3])});
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
    return 1;
  }
  return 0;
}
