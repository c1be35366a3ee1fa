#include "sigmascape/scene/facet_area.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

TEST(FacetArea, ABoxHasItsSixFaces) {
  const Mesh box = box_mesh({2.0F, 3.0F, 5.0F}, 0);
  const auto areas = facet_areas_m2(box);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const Vec3f a = box.vertices[box.triangles[t][0]];
    const Vec3f n = normalized(cross(box.vertices[box.triangles[t][1]] - a, box.vertices[box.triangles[t][2]] - a));
    const float expected = std::abs(n.x) > 0.5F ? 15.0F : std::abs(n.y) > 0.5F ? 10.0F : 6.0F;
    EXPECT_NEAR(areas[t], expected, 1e-4F);
  }
}

// However finely a wall is cut, and with vertices of their own for every triangle, it is one face.
TEST(FacetArea, DoesNotDependOnTheTriangulation) {
  Mesh wall;
  for (int i = 0; i < 8; ++i) {
    const auto x = static_cast<float>(i);
    const std::array<Vec3f, 4> corners{{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 0, 4}, {x, 0, 4}}};
    append_facet(wall, corners, 0);
  }
  for (const float area : facet_areas_m2(wall)) EXPECT_NEAR(area, 32.0F, 1e-3F);
}

// As exported to be seen from both sides.
TEST(FacetArea, APanelThatIsThereTwiceIsOneFace) {
  Mesh panel;
  const std::array<Vec3f, 4> front{{{0, 0, 0}, {2, 0, 0}, {2, 0, 3}, {0, 0, 3}}},
      back{{{0, 0, 0}, {0, 0, 3}, {2, 0, 3}, {2, 0, 0}}};
  append_facet(panel, front, 0);
  append_facet(panel, back, 0);
  for (const float area : facet_areas_m2(panel)) EXPECT_NEAR(area, 6.0F, 1e-4F);
}

// The same, cut along the other diagonal on its back: front and back lie upon one another, and each is one face.
TEST(FacetArea, APanelWhoseBackIsCutOtherwiseIsTwoFacesOfItsArea) {
  for (const int quads : {1, 2, 3}) {
    Mesh panel;
    for (int i = 0; i < quads; ++i) {
      const auto west = static_cast<float>(2 * i), east = west + 2.0F;
      const std::array<Vec3f, 4> front{{{west, 0, 0}, {east, 0, 0}, {east, 0, 3}, {west, 0, 3}}},
          back{{{east, 0, 0}, {west, 0, 0}, {west, 0, 3}, {east, 0, 3}}};
      append_facet(panel, front, 0);
      append_facet(panel, back, 0);
    }
    for (const float area : facet_areas_m2(panel)) EXPECT_NEAR(area, 6.0F * static_cast<float>(quads), 1e-4F) << quads;
  }
}

/// Two walls of 3 m² that meet at a corner, bent by so much; the second wound the same way round or the other.
std::vector<float> areas_of_bent_wall(double bend_deg, bool wound_alike = true) {
  const double bend = radians_from_deg(bend_deg);
  const auto east = static_cast<float>(1.0 + std::cos(bend)), north = static_cast<float>(std::sin(bend));
  Mesh wall;
  const std::array<Vec3f, 4> straight{{{0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {0, 0, 3}}},
      bent{{{1, 0, 0}, {east, north, 0}, {east, north, 3}, {1, 0, 3}}},
      turned{{{1, 0, 0}, {1, 0, 3}, {east, north, 3}, {east, north, 0}}};
  append_facet(wall, straight, 0);
  append_facet(wall, wound_alike ? bent : turned, 0);
  return facet_areas_m2(wall);
}

TEST(FacetArea, ASkinIsOneFaceAcrossGentleBends) {
  for (const double bend_deg : {-19.0, 0.0, 10.0, 19.0}) {
    for (const bool wound_alike : {true, false}) {
      for (const float area : areas_of_bent_wall(bend_deg, wound_alike))
        EXPECT_NEAR(area, 6.0F, 1e-4F) << bend_deg << "°" << (wound_alike ? "" : ", turned");
    }
  }
  for (const double bend_deg : {-90.0, 21.0, 45.0, 90.0, 161.0, 179.0}) {
    for (const bool wound_alike : {true, false}) {
      for (const float area : areas_of_bent_wall(bend_deg, wound_alike))
        EXPECT_NEAR(area, 3.0F, 1e-4F) << bend_deg << "°" << (wound_alike ? "" : ", turned");
    }
  }
}

TEST(FacetArea, FacesOfOnePlaneThatDoNotTouchStayApart) {
  Mesh tiles;
  const std::array<Vec3f, 4> here{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
      there{{{5, 0, 0}, {7, 0, 0}, {7, 1, 0}, {5, 1, 0}}};
  append_facet(tiles, here, 0);
  append_facet(tiles, there, 0);
  const auto areas = facet_areas_m2(tiles);
  EXPECT_NEAR(areas.front(), 1.0F, 1e-5F);
  EXPECT_NEAR(areas.back(), 2.0F, 1e-5F);
}

}  // namespace
}  // namespace sigmascape::scene
