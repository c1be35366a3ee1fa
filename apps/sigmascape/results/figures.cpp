#include "results/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <optional>

#include "map_files.h"
#include "results/captions.h"
#include "results/draped_view.h"
#include "results/optical_view.h"

#include "sigmascape/bake/paper_baker.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/attribution_line.h"
#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/legend.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/product/rectangle_fill.h"
#include "sigmascape/scene/simple_scene.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::cli {
namespace {

constexpr std::size_t pixels_wide = 512;
constexpr product::Rgba ink{255, 190, 40}, behind_ink{18, 18, 18}, not_compared{150, 150, 150};
/// Wall and ground: enough for the dihedral. What bounces more often comes late, lies in the shadows, and is found by
/// few rays.
constexpr int bounces_of_simple_scene = 2;

/// A word beside a place of a picture, and a line between them.
struct Label {
  std::string text;
  Vec2d place, at;
  bool is_left_of_line = false;
};

void draw(product::Picture& picture, const Label& label) {
  const Vec2d from = picture.grid.cells_from(label.place);
  const Vec2d to = picture.grid.cells_from(label.at);
  const auto pixel = [&](Vec2d p) {
    return std::pair(static_cast<std::size_t>(std::clamp(p.x, 0.0, static_cast<double>(picture.pixels.columns() - 1))),
                     static_cast<std::size_t>(std::clamp(p.y, 0.0, static_cast<double>(picture.pixels.rows() - 1))));
  };
  constexpr int dots = 200;
  for (int i = 0; i <= dots; ++i) {
    const auto [column, row] = pixel(from + (to - from) * (static_cast<double>(i) / dots));
    picture.pixels(column, row) = ink;
  }
  constexpr std::size_t dot_size = 2, rim = 3;
  const std::size_t width = product::text_width(label.text, dot_size) + 2 * rim;
  const std::size_t height = (product::glyph_height + product::glyph_depth) * dot_size + 2 * rim;
  const auto [line_end, middle] = pixel(to);
  const std::size_t column = !label.is_left_of_line ? line_end : line_end - std::min(line_end, width);
  const std::size_t row = middle - std::min(middle, height / 2);
  product::fill_rectangle(picture.pixels, {column, row, width, height}, behind_ink);
  product::draw_text(picture.pixels, column + rim, row + rim, label.text, dot_size, ink);
}

/// What stands on the plane of Figure 1, seen from the south-east.
struct SimpleObject {
  Vec2d centre;
  double depth_m, height_m;  ///< from the centre to the side that faces the radar
};

std::vector<Label> labels_of(const SimpleObject& object, const radar::Aspect& aspect) {
  const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad), right{-towards.y, towards.x};
  const double tangent = std::tan(aspect.elevation_rad);
  const auto label = [&](const char* text, double before_m, double aside_m) {
    const Vec2d place = object.centre + towards * before_m;
    return Label{text, place, place + right * aside_m, aside_m < 0.0};
  };
  return {label("shadow", -object.depth_m - object.height_m / tangent / 2.0, 20.0),
          label("dihedral", object.depth_m, -16.0),
          label("layover", object.depth_m + object.height_m * tangent * 0.6, -25.0)};
}

scene::SimpleSceneOptions simple_options(const ResultsPlan& plan) {
  return {.box_centre = {-22.0, 6.0},
          .box_size_m = {16.0F, 24.0F, 12.0F},
          .box_yaw_rad = radians_from_deg(45.0),
          .cylinder_centre = {24.0, -4.0},
          .ground_material = "grass",
          .object_material = plan.materials == scene::PaperMaterials::Paper ? "paper_building" : "concrete"};
}

/// Smooth walls would show no layover: all that they return comes by way of the ground.
scene::Scene with_diffuse_walls(scene::Scene scene) {
  for (scatter::Material& material : scene.materials) {
    if (auto* walls = std::get_if<scatter::CookTorranceParameters>(&material.model))
      walls->scattering_coefficient = 0.15;
  }
  return scene;
}

/// What a radar of the fineness of the picture's cells makes of the simple scene, path-traced.
radar::GroundMap simple_map(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                            const radar::Aspect& aspect, const radar::GroundGrid& grid, const ResultsPlan& plan) {
  radar::Radar radar{.name = "20 km, from the south-east"};
  radar.position = radar::position_seeing({}, aspect.azimuth_rad, aspect.elevation_rad, 20e3);
  radar.polarization = radar::Polarization::Sum;
  radar.range_resolution_m = grid.cell_m;
  radar.beam_width_rad = grid.cell_m * std::sqrt(2.0) / 20e3;
  trace::TraceCounts counts;
  const auto image = simulate::traced_image(scene, geometry, radar, grid.extent(),
                                            {.cell_m = grid.cell_m,
                                             .samples_per_cell = std::min(16 * plan.traced_samples, 8192U),
                                             .max_bounces = bounces_of_simple_scene,
                                             .seed = plan.seed,
                                             .threads = plan.threads},
                                            counts);
  return described_map(image, radar, scene.terrain, grid, scene.frame, {{"scene", scene.name}});
}

/// The paper's texture of the simple scene from that side.
radar::GroundMap simple_texture(const scene::Scene& scene, const radar::Aspect& aspect, const radar::GroundGrid& grid,
                                const ResultsPlan& plan) {
  bake::BakeSettings settings = plan.bake_settings(Method::Paper);
  settings.patches.texel_m = grid.cell_m;
  settings.sampling.samples_per_texel = std::min(16 * plan.traced_samples, 4096U);
  settings.max_bounces = bounces_of_simple_scene;
  return {.grid = grid,
          .sigma0 = bake::PaperBaker(scene, settings).bake(grid, aspect),
          .crs = scene.frame.proj(),
          .metadata = {{"scene", scene.name}}};
}

product::PageSection simple_section(const ResultsPlan& plan, const std::filesystem::path& folder) {
  const radar::Aspect aspect{radians_from_deg(135.0), radians_from_deg(30.0)};
  const scene::SimpleSceneOptions options = simple_options(plan);
  const scene::Scene scene = with_diffuse_walls(scene::simple_scene(options));
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const radar::GroundGrid grid{scene.extent.west_m, scene.extent.north_m, 0.5, 256, 256};
  product::PictureOptions look{.polarization = radar::Polarization::Sum};
  look.top_percentile = 99.95;
  look.magnification = 2;
  const radar::GroundMap map = simple_map(scene, geometry, aspect, grid, plan);
  look.top_db = product::percentile_top_db(map, look);
  product::Picture labelled = product::picture_of(map, look);
  const std::vector<SimpleObject> objects{
      {options.box_centre, 8.0, static_cast<double>(options.box_size_m.z)},
      {options.cylinder_centre, options.cylinder_radius_m, options.cylinder_height_m}};
  for (const SimpleObject& object : objects) {
    for (const Label& label : labels_of(object, aspect)) draw(labelled, label);
  }
  const product::Picture seen = optical_view(scene, geometry, pixels_wide, plan.threads);
  const product::Picture baked = product::picture_of(simple_texture(scene, aspect, grid, plan), look);

  const auto optical = folder / "figure_1_optical.png", radar_map = folder / "figure_1_radar.png",
             optical_texture = folder / "figure_1_optical_texture.png",
             radar_texture = folder / "figure_1_radar_texture.png";
  product::write_png(optical, product::with_legend(seen, {.colour_scale = false}));
  product::write_png(radar_map, product::with_legend(labelled));
  // Seen obliquely, they lie nowhere on a map and have no world file.
  geo::write_atomically(optical_texture, product::png_bytes(draped_view(seen, pixels_wide)));
  geo::write_atomically(radar_texture,
                        product::png_bytes(product::with_legend(draped_view(baked, pixels_wide),
                                                                {.scale_bar = false, .north_arrow = false})));
  return {.heading = "Figure 1: what a radar shows of simple things",
          .paragraphs = {fmt::format(
              "Objects of {} on {}. Of what the walls reflect, a part of 0.15² leaves diffusely: walls that only "
              "mirror would show no layover. Echoes have at most two bounces; those of more arrive late, so that they "
              "lie in the shadows, and few rays find them. The faint specks in the shadows are late echoes of two.",
              options.object_material == "concrete" ? "concrete" : "the paper's building material",
              options.ground_material)},
          .figures = {
              {optical, "(a) A prism and a cylinder on a plane, from above, lit from the south-east"},
              {radar_map,
               "(b) The same path-traced for a radar in the south-east, 30° high, dB of σ0: the shadow behind each "
               "object, the layover of wall and roof in front of it, the bright dihedral line where wall and "
               "ground meet"},
              {optical_texture, "(c) What an eye sees, view (a), as a texture on the triangles of a heightmap"},
              {radar_texture,
               "(d) What the radar sees, baked in the paper's way, as a texture on the same triangles; on the scale "
               "of (b)"}}};
}

product::PageSection scene_section(const Measurement& measurement, const ResultsPlan& plan,
                                   const std::filesystem::path& folder) {
  const MeasuredScene& measured = measurement.scene();
  const auto optical = folder / "figure_5_scene.png", materials = folder / "figure_6_materials.png";
  const MaterialView ground = material_view(measured.scene, pixels_wide);
  const auto write = [](const std::filesystem::path& path, const product::Picture& picture) {
    product::write_png(path, product::with_attribution(product::with_legend(picture, {.colour_scale = false})));
  };
  write(optical, optical_view(measured.scene, measured.geometry, pixels_wide, plan.threads));
  write(materials, ground.picture);
  product::PageSection section{
      .heading = ground.classes > 1 ? "Figures 5 and 6: the scene" : "Figure 5: the scene",
      .figures = {
          {optical,
           "Surfaces in the colours of their materials, from above, lit from the south-east, where the radar stands"}}};
  if (ground.classes > 1) {
    section.figures.push_back({materials, "Materials of the ground: " + ground.legend});
  } else {
    section.paragraphs.push_back(
        "The ground is of one material: " +
        measured.scene.materials[measured.scene.ground.at(measured.scene.extent.centre())].name +
        ", so that there is nothing to show in Figure 6.");
  }
  return section;
}

/// A baked texture by itself, as a map reads it: bilinearly in power.
radar::GroundMap texture_map(const Measurement& measurement, const radar::Aspect& aspect) {
  const scene::Scene& scene = measurement.scene().scene;
  const render::PaperTextures& textures = measurement.paper_textures();
  const double pixel_m = scene.extent.width_m() / static_cast<double>(pixels_wide);
  radar::GroundMap map{.grid = simulate::map_grid({.area = {}, .cell_m = pixel_m}, scene.extent),
                       .sigma0 = {},
                       .crs = scene.frame.proj(),
                       .metadata = {{"scene", scene.name}, {"attribution", scene.attribution}}};
  map.sigma0 = Array2D<radar::Channels>(map.grid.columns, map.grid.rows);
  const auto weights = textures.weights_for(aspect, {});
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column)
      map.sigma0(column, row) = textures.sigma0_at(map.grid.centre_of(column, row), weights, 0.0);
  }
  return map;
}

unsigned magnification_of(const radar::GroundMap& map) {
  return static_cast<unsigned>(std::clamp<std::size_t>(pixels_wide / map.grid.columns, 1, 4));
}

product::PageSection texture_section(const Measurement& measurement, const std::filesystem::path& folder) {
  constexpr double elevations_deg[] = {5.0, 13.0, 21.0, 29.0};
  std::vector<radar::GroundMap> maps;
  product::PictureOptions look{.polarization = radar::Polarization::Sum};
  // Walls and crowns that are brighter may be white, so that level ground is no darker than it must.
  look.top_percentile = 97.0;
  for (const double elevation_deg : elevations_deg) {
    maps.push_back(texture_map(measurement, {radians_from_deg(135.0), radians_from_deg(elevation_deg)}));
    const double top_db = product::percentile_top_db(maps.back(), look);
    look.top_db = std::max(look.top_db.value_or(top_db), top_db);
  }
  product::PageSection section{
      .heading = "Figure 7: baked reflectivity, seen from the south-east (azimuth 135°)",
      .paragraphs = {
          fmt::format("Textures baked in the paper's way, on flat ground, from four elevations: dB of σ0, sum of "
                      "polarizations, read bilinearly in power as a map reads them, all on one scale, {:.0f} to {:.0f} "
                      "dB; what is brighter is white.",
                      *look.top_db - look.span_db, *look.top_db)}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto path = folder / fmt::format("figure_7_el{:02.0f}.png", elevations_deg[i]);
    write_map_picture(path, maps[i], look);
    section.figures.push_back({path, fmt::format("{:.0f}° elevation", elevations_deg[i])});
  }
  return section;
}

/// The rim of a picture in the colour of what is not compared.
void paint_rim(product::Picture& picture, double rim_m) {
  const auto rim = static_cast<std::size_t>(std::lround(rim_m / picture.grid.cell_m));
  const std::size_t columns = picture.pixels.columns(), rows = picture.pixels.rows();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t inwards = std::min({column, row, columns - 1 - column, rows - 1 - row});
      if (inwards < rim) picture.pixels(column, row) = not_compared;
    }
  }
}

/// A way to a map that is pictured.
struct PicturedWay {
  Method method;
  std::string grid;
  const char* key;  ///< in the names of its files

  [[nodiscard]] std::string words() const { return text_of(method) + ", " + grid; }
};

std::vector<PicturedWay> pictured_ways(const ResultsPlan& plan) {
  return {{Method::Paper, plan.paper_grid().name(), "paper"},
          {Method::OwnGround, plan.paper_grid().name(), "ours"},
          {Method::OwnGround, plan.grids.back().name(), "ours_finest"}};
}

/// Of a map from textures; with what was measured of it, where it was.
std::string measured_caption(const Measurement& measurement, const ResultsPlan& plan, const PlannedView& view,
                             const PicturedWay& way) {
  const ViewResult* result = find_view(measurement.results(), plan, view, way.method, way.grid);
  return result != nullptr ? caption_of(*result) : way.words();
}

/// The same of the traced map.
std::string measured_caption(const Measurement& measurement, const ResultsPlan& plan, const PlannedView& view) {
  const PicturedWay way = pictured_ways(plan).front();
  const ViewResult* result = find_view(measurement.results(), plan, view, way.method, way.grid);
  if (result == nullptr) return "Path-traced from the full scene";
  return traced_caption(*result, measurement.scene().geometry.memory_bytes());
}

/// One view traced and rendered in several ways, on one scale, and the differences.
product::PageSection pictured(const Measurement& measurement, const ResultsPlan& plan, const PlannedView& view,
                              const std::string& name, const std::string& heading,
                              const std::filesystem::path& folder) {
  Truth truth = measurement.truth_of(view);
  const scene::Scene& scene = measurement.scene().scene;
  truth.mean = product::described_map(std::move(truth.mean),
                                      simulate::placed_radar(view.radar(), scene.frame, scene.terrain, scene.extent),
                                      scene.frame, {{"scene", scene.name}, {"attribution", scene.attribution}});
  product::PictureOptions look = product::scope_look();
  look.polarization = radar::Polarization::Sum;
  look.top_db = product::percentile_top_db(truth.mean, look);
  look.magnification = magnification_of(truth.mean);
  const product::DifferenceOptions difference{
      .polarization = look.polarization, .span_db = 40.0, .magnification = look.magnification};
  const auto path = [&](const std::string& what) { return folder / fmt::format("{}_{}.png", name, what); };
  write_map_picture(path("traced"), truth.mean, look);
  product::PageSection section{
      .heading = heading,
      .paragraphs = {fmt::format(
          "The green pictures are of the sum of polarizations in dB of σ0, all on one scale of {:g} dB, low-pass "
          "filtered as on a scope. The others are error maps, the rendered map over the traced one in cells of {:g} m, "
          "not filtered: red is too bright, blue too dark, 20 dB or more in full colour; what is below {:g} dB counts "
          "as "
          "{:g} dB in both, so that shadows that both have are white; grey is the rim that is not compared. Seconds "
          "are "
          "the processor time of one map.",
          look.span_db, truth.mean.grid.cell_m, difference.floor_db, difference.floor_db)},
      .figures = {{path("traced"), measured_caption(measurement, plan, view)}}};
  std::vector<product::PageFigure> differences;
  for (const PicturedWay& way : pictured_ways(plan)) {
    const radar::GroundMap map = measurement.map_of(view, way.method, way.grid);
    write_map_picture(path(way.key), map, look);
    section.figures.push_back({path(way.key), measured_caption(measurement, plan, view, way)});
    const auto difference_path = path(fmt::format("{}_difference", way.key));
    product::Picture over_traced = product::difference_picture(map, truth.mean, difference);
    paint_rim(over_traced, plan.rim_m());
    product::write_png(difference_path, product::with_attribution(product::with_legend(over_traced)));
    differences.push_back({difference_path, "Error map: " + way.words()});
  }
  std::ranges::move(differences, std::back_inserter(section.figures));
  return section;
}

/// None where no view was held out.
std::optional<PlannedView> worst_view(const Measurement& measurement, const ResultsPlan& plan) {
  const ResultsCase wanted{.scene = plan.scene_name(),
                           .method = Method::Paper,
                           .grid = plan.paper_grid().name(),
                           .baked_samples = plan.baked_samples,
                           .kind = ViewKind::HeldOut};
  std::optional<PlannedView> worst;
  double lowest = 2.0;
  for (const ViewResult& result : measurement.results()) {
    const product::CellComparison* cell = result.comparison.at_cell(8.0);
    if (result.of != wanted || cell == nullptr || !(cell->correlation_db < lowest)) continue;
    lowest = cell->correlation_db;
    worst = result.view;
  }
  return worst;
}

}  // namespace

std::vector<product::PageSection> paper_figures(const Measurement& measurement, const ResultsPlan& plan,
                                                const std::filesystem::path& folder) {
  std::vector<product::PageSection> sections;
  // Of a real place its own pictures are asked for.
  if (plan.scene_file.empty()) sections.push_back(simple_section(plan, folder));
  std::ranges::move(
      std::vector{scene_section(measurement, plan, folder), texture_section(measurement, folder),
                  pictured(measurement, plan, plan.views.front(), "figure_8",
                           "Figure 8: the paper's view, 20 km away, azimuth 130°, elevation 8.6°, 50 dB", folder)},
      std::back_inserter(sections));
  if (const auto worst = worst_view(measurement, plan)) {
    sections.push_back(pictured(
        measurement, plan, *worst, "worst",
        "The worst view: where the paper's method correlates least with the truth, " + worst->description(), folder));
  }
  return sections;
}

}  // namespace sigmascape::cli
