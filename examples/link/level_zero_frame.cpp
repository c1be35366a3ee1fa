// The same pose at level of detail 0, traced through the whole scene, and at level 1, from baked textures: two pictures
// beside one another, mean power above and I/Q with speckle below. What draws them does not know which level they are.
//
//   level_zero_frame SCENE ATLAS OUT.png     a scene file, the atlas that `sigmascape bake` made of it, a picture

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <memory>

#include "sigmascape/base/units.h"
#include "sigmascape/live/detail_of_ground.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/product/picture.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/product/scope_layout.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/live_tracer.h"

namespace {

using namespace sigmascape;

constexpr double azimuth_rad = radians_from_deg(130.0), elevation_rad = radians_from_deg(8.6), slant_range_m = 20e3;
constexpr double bin_m = 3.0;

/// Bins of 3 m on the ground, as many as the scene is wide.
live::LiveSettings settings_for(const scene::Scene& scene, live::FrameContent content) {
  live::LiveSettings settings;
  settings.content = content;
  settings.beams = settings.ranges = static_cast<std::size_t>(std::min(scene.extent.width_m(), 512.0) / bin_m);
  settings.range_step_m = bin_m * std::cos(elevation_rad);
  settings.beam_step_rad = bin_m / (slant_range_m * std::cos(elevation_rad));
  return settings;
}

/// From the south-east onto the middle of the scene.
live::Pose pose_over(const scene::Scene& scene, const live::LiveSettings& settings) {
  const Vec2d middle = scene.extent.centre();
  const Vec3d target{middle.x, middle.y, scene.terrain.height_at(middle)};
  // The renderer's Earth is round; aimed over a flat one, a radar farther away would look past the scene.
  const radar::CurvedEarth earth{.refraction = settings.refraction};
  return {.position = radar::position_seeing(target, azimuth_rad, elevation_rad, slant_range_m, earth),
          .first_azimuth_rad = azimuth_rad + pi - 0.5 * static_cast<double>(settings.beams) * settings.beam_step_rad,
          .first_range_m = slant_range_m - 0.5 * static_cast<double>(settings.ranges) * settings.range_step_m};
}

/// Seen from above, with the radar below the picture.
product::Picture picture_of(const live::Frame& frame, double top_db) {
  const auto map = product::ppi(live::image_of(frame), {.up_rad = azimuth_rad + pi, .longer_side = 512});
  return product::picture_of(map, {.top_db = top_db});
}

product::Picture beside(const product::Picture& left, const product::Picture& right) {
  const std::size_t columns = left.pixels.columns(), rows = left.pixels.rows();
  product::Picture both = left;
  both.pixels = Array2D<product::Rgba>(2 * columns, rows);
  both.grid.columns = 2 * columns;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      both.pixels(column, row) = left.pixels(column, row);
      both.pixels(columns + column, row) = right.pixels(column, row);
    }
  }
  return both;
}

product::Picture above(const product::Picture& upper, const product::Picture& lower) {
  const std::size_t columns = upper.pixels.columns(), rows = upper.pixels.rows();
  product::Picture both = upper;
  both.pixels = Array2D<product::Rgba>(columns, 2 * rows);
  both.grid.rows = 2 * rows;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      both.pixels(column, row) = upper.pixels(column, row);
      both.pixels(column, rows + row) = lower.pixels(column, row);
    }
  }
  return both;
}

/// Level 0 on the left and level 1 on the right.
product::Picture levels_beside(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                               const std::shared_ptr<live::LiveGround>& ground, live::FrameContent content) {
  const live::LiveSettings settings = settings_for(scene, content);
  const live::Pose pose = pose_over(scene, settings);
  // Cells of the lattice as large as the texels give both levels the same scatterers.
  const double texel_m = ground->description().patches.texel_m;
  simulate::LiveTracer tracer(scene, geometry, settings,
                              {.frequency_hz = ground->frequency_hz(), .lattice_m = texel_m});
  live::LiveRenderer renderer(ground, settings);

  // Every call adds rays; a simulator shows each of these frames.
  for (int call = 0; call < 3; ++call) tracer.render(pose);
  const live::Frame& traced = tracer.render(pose);
  std::cout << traced.report.rays_per_cell << " rays a cell tell the power of a bin to "
            << traced.report.median_error_db << " dB\n";
  renderer.render(pose);
  ground->wait_until_loaded();
  const live::Frame& baked = renderer.render(pose);
  const double top_db = product::percentile_top_db(product::ppi(live::image_of(traced)));
  return beside(picture_of(traced, top_db), picture_of(baked, top_db));
}

/// Says which of the two a program would take that has both.
void explain_choice(const scene::Scene& scene, const trace::SceneGeometry& geometry, const live::LiveGround& ground) {
  const live::LiveSettings settings = settings_for(scene, live::FrameContent::Powers);
  const simulate::LiveTracer tracer(scene, geometry, settings);
  const auto question = live::with_ground(tracer.question(pose_over(scene, settings)), ground);
  std::cout << render::explained(render::choose_detail(question));
}

void draw_levels(const char* scene_file, const char* atlas, const char* picture) {
  const scene::Scene scene = scene::read_scene(scene_file);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const auto ground = live::LiveGround::open(atlas, 10e9);
  explain_choice(scene, geometry, *ground);
  product::write_png(picture, above(levels_beside(scene, geometry, ground, live::FrameContent::Powers),
                                    levels_beside(scene, geometry, ground, live::FrameContent::Amplitudes)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: " << argv[0] << " SCENE ATLAS OUT.png\n";
    return 2;
  }
  try {
    draw_levels(argv[1], argv[2], argv[3]);
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << '\n';
    return 1;
  }
  return 0;
}
