#include "bias.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "noise.h"

namespace sigmascape::bench {
namespace {

constexpr std::size_t piece_texels = 64, texels_around = 32;

/// Counts of what stands in each of the squares into which the scene is cut.
class Squares {
 public:
  Squares(const radar::Rectangle& extent, double side_m)
      : extent_(extent),
        side_m_(side_m),
        columns_(static_cast<std::size_t>(extent.width_m() / side_m)),
        rows_(static_cast<std::size_t>(extent.height_m() / side_m)),
        of_town_(columns_ * rows_),
        of_forest_(columns_ * rows_) {}

  void add_town(double x_m, double y_m) { add(of_town_, x_m, y_m); }
  void add_forest(double x_m, double y_m) { add(of_forest_, x_m, y_m); }

  [[nodiscard]] radar::Rectangle with_most_of_both() const {
    std::size_t best = 0;
    const auto both = [&](std::size_t i) { return of_town_[i] * of_forest_[i]; };
    for (std::size_t i = 1; i < of_town_.size(); ++i) best = both(i) > both(best) ? i : best;
    const double west_m = extent_.west_m + static_cast<double>(best % columns_) * side_m_;
    const double south_m = extent_.south_m + static_cast<double>(best / columns_) * side_m_;
    return {west_m, south_m, west_m + side_m_, south_m + side_m_};
  }

 private:
  void add(std::vector<double>& counts, double x_m, double y_m) const {
    const double column = std::floor((x_m - extent_.west_m) / side_m_);
    const double row = std::floor((y_m - extent_.south_m) / side_m_);
    if (column < 0.0 || row < 0.0 || column >= static_cast<double>(columns_) || row >= static_cast<double>(rows_))
      return;
    counts[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)] += 1.0;
  }

  radar::Rectangle extent_;
  double side_m_;
  std::size_t columns_, rows_;
  std::vector<double> of_town_, of_forest_;
};

radar::Rectangle town_and_forest(const scene::Scene& scene, double side_m) {
  Squares squares(scene.extent, side_m);
  for (const Vec3f& corner : scene.buildings.mesh.vertices) squares.add_town(corner.x, corner.y);
  for (const scene::Instance& tree : scene.instances) squares.add_forest(tree.x_m, tree.y_m);
  return squares.with_most_of_both();
}

/// Of looks of a piece and what is around it, the piece.
std::vector<float> middle_of(const std::vector<float>& power) {
  constexpr std::size_t side = piece_texels + 2 * texels_around;
  std::vector<float> middle;
  for (std::size_t row = texels_around; row < texels_around + piece_texels; ++row) {
    const auto begin = power.begin() + static_cast<std::ptrdiff_t>(row * side + texels_around);
    middle.insert(middle.end(), begin, begin + static_cast<std::ptrdiff_t>(piece_texels));
  }
  return middle;
}

}  // namespace

Bias bias_in_town_and_forest(const scene::Scene& scene, const radar::Aspect& aspect, const bake::Sampling& sampling,
                             std::uint32_t plain_samples) {
  const double texel_m = bake::BakeSettings{}.patches.texel_m;
  const radar::Rectangle piece = town_and_forest(scene, static_cast<double>(piece_texels) * texel_m);
  const double around_m = static_cast<double>(texels_around) * texel_m;
  PaperLooks looks(
      scene, {piece.west_m - around_m, piece.south_m - around_m, piece.east_m + around_m, piece.north_m + around_m}, 1,
      2);
  constexpr std::uint64_t seed = 200;
  const auto ours = middle_of(looks.ours(aspect, sampling, seed).power);
  const auto ours_again = middle_of(looks.ours(aspect, sampling, seed + 1).power);
  const auto plain = middle_of(looks.plain(aspect, plain_samples, seed + 2).power);
  const auto plain_again = middle_of(looks.plain(aspect, plain_samples, seed + 3).power);
  const Total of_ours = total_of(ours, ours_again), of_plain = total_of(plain, plain_again);
  return {of_ours.power / of_plain.power, std::hypot(of_ours.standard_error, of_plain.standard_error) / of_plain.power,
          piece};
}

}  // namespace sigmascape::bench
