#include "sigmascape/simulate/map_provenance.h"

#include <gtest/gtest.h>

namespace sigmascape::simulate {
namespace {

TEST(MapProvenance, TellsWhatMakesTracedMapsDiffer) {
  const std::vector<radar::Target> targets(2);
  scene::Scene scene;
  scene.point_targets.resize(3);
  const auto words =
      provenance_of_traced({.samples_per_cell = 9, .max_bounces = 3, .seed = 7, .targets = targets}, scene, 1);
  EXPECT_EQ(words.at("samples_per_cell"), "9");
  EXPECT_EQ(words.at("bounces"), "3");
  EXPECT_EQ(words.at("seed"), "7");
  EXPECT_EQ(words.at("targets"), "5");
}

TEST(MapProvenance, NamesTheTexturesFrequencyWhereTheRadarHasAnother) {
  atlas::AtlasDescription atlas;
  atlas.settings["seed"] = "11";
  radar::Radar radar;
  radar.frequency_hz = 35e9;
  const auto own = provenance_of_baked(atlas, radar, {.level_of_detail = 2}, 1, 0, 0);
  EXPECT_EQ(own.at("processing"), "level of detail 2: from terrain and atlas");
  EXPECT_EQ(own.at("atlas_seed"), "11");
  EXPECT_FALSE(own.contains("texture_frequency_hz"));
  const auto other = provenance_of_baked(atlas, radar, {.texture_frequency_hz = 10e9}, 1, 0, 0);
  EXPECT_EQ(other.at("texture_frequency_hz"), "10000000000");
}

}  // namespace
}  // namespace sigmascape::simulate
