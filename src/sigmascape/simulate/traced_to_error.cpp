#include "sigmascape/simulate/traced_to_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/simulate/launch_for_map.h"

namespace sigmascape::simulate {
namespace {

/// Fewer tell too little of their scatter.
constexpr std::uint32_t fewest_passes = 8;

void check(const ErrorGoal& goal) {
  if (goal.median_error_db > 0.0 && goal.samples_a_pass > 0 && goal.most_passes >= fewest_passes) return;
  throw Error("error goal of a traced map",
              fmt::format("asks for {} dB by up to {} passes of {} rays", goal.median_error_db, goal.most_passes,
                          goal.samples_a_pass),
              fmt::format("give a positive error, at least one ray and at least {} passes", fewest_passes));
}

/// Median of the square root of a variance that was estimated with so many degrees of freedom, over the root of the
/// true variance: the median of chi-squared by Wilson and Hilferty.
double median_of_estimated_deviation(double freedom) {
  return std::pow(1.0 - 2.0 / (9.0 * freedom), 1.5);
}

/// Sums over the passes, bin by bin.
class PassSums {
 public:
  PassSums(const radar::RangeAzimuthImage& first, const radar::Rectangle& area, double ground_height_m)
      : image_(first), power_(first.rcs_m2.columns(), first.rcs_m2.rows()), squares_(power_.columns(), power_.rows()) {
    std::ranges::fill(image_.rcs_m2.values(), radar::Channels{});
    sums_.resize(4 * power_.values().size());
    find_bins_of(area, ground_height_m);
  }

  void add(const radar::RangeAzimuthImage& pass) {
    const auto values = pass.rcs_m2.values();
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
      const radar::Channels& value = values[bin];
      const double channels[] = {value.vv, value.hh, value.hv, value.re_vvhh};
      for (std::size_t c = 0; c < 4; ++c) sums_[4 * bin + c] += channels[c];
      const double power = value.power(radar::Polarization::Sum);
      power_.values()[bin] += power;
      squares_.values()[bin] += power * power;
    }
    ++passes_;
  }

  [[nodiscard]] std::uint32_t passes() const { return passes_; }

  [[nodiscard]] double median_error_db() const {
    std::vector<double> errors;
    for (const std::size_t bin : bins_) {
      if (power_.values()[bin] > 0.0) errors.push_back(relative_error(bin));
    }
    if (errors.empty()) return 0.0;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    return 10.0 * std::log10(1.0 + *middle / median_of_estimated_deviation(static_cast<double>(passes_ - 1)));
  }

  [[nodiscard]] TracedToError result() && {
    TracedToError traced;
    traced.relative_errors = Array2D<float>(power_.columns(), power_.rows());
    for (std::size_t bin = 0; bin < power_.values().size(); ++bin) {
      const auto mean = [&](std::size_t c) { return static_cast<float>(sums_[4 * bin + c] / passes_); };
      image_.rcs_m2.values()[bin] = {mean(0), mean(1), mean(2), mean(3)};
      const bool answers = power_.values()[bin] > 0.0;
      traced.relative_errors.values()[bin] = answers ? static_cast<float>(relative_error(bin)) : 0.0F;
    }
    traced.image = std::move(image_);
    return traced;
  }

 private:
  /// Bins whose ground, taken to be level, lies in the area.
  void find_bins_of(const radar::Rectangle& area, double ground_height_m) {
    const radar::RangeAzimuthGrid& grid = image_.grid;
    const double below_m = image_.radar_position.z - ground_height_m;
    for (std::size_t range = 0; range < grid.ranges; ++range) {
      const double slant_m = grid.first_range_m + (static_cast<double>(range) + 0.5) * grid.range_step_m;
      const double ground_m = std::sqrt(std::max(slant_m * slant_m - below_m * below_m, 0.0));
      for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
        const double azimuth = grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad;
        const double x = image_.radar_position.x + ground_m * std::sin(azimuth);
        const double y = image_.radar_position.y + ground_m * std::cos(azimuth);
        const bool inside = x >= area.west_m && x <= area.east_m && y >= area.south_m && y <= area.north_m;
        if (inside) bins_.push_back(range * grid.azimuths + beam);
      }
    }
  }

  /// Of the mean over the passes.
  [[nodiscard]] double relative_error(std::size_t bin) const {
    const double n = passes_, sum = power_.values()[bin];
    const double scatter = std::max(squares_.values()[bin] - sum * sum / n, 0.0);
    return std::sqrt(scatter * n / (n - 1.0)) / sum;
  }

  radar::RangeAzimuthImage image_;
  std::vector<double> sums_;         // [bin][channel]
  Array2D<double> power_, squares_;  // of the total power
  std::vector<std::size_t> bins_;
  std::uint32_t passes_ = 0;
};

}  // namespace

TracedToError traced_to_error(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                              const radar::Radar& radar, const radar::Rectangle& area, const TraceSettings& settings,
                              const ErrorGoal& goal, trace::TraceCounts& counts, ProgressListener* progress) {
  check(goal);
  const Vec2d middle = area.centre();
  const trace::LaunchArea launch = launch_for_map(scene, geometry, radar, area, settings.cell_m);
  std::optional<PassSums> sums;
  double error_db = 0.0;
  for (std::uint32_t pass = 0; pass < goal.most_passes; ++pass) {
    TraceSettings of_pass = settings;
    of_pass.samples_per_cell = goal.samples_a_pass;
    of_pass.seed = hashed(settings.seed, pass);
    const auto image = std::move(traced_bounces(scene, geometry, radar, launch, of_pass, 1, counts).front());
    if (!sums) sums.emplace(image, area, scene.terrain.height_at(middle));
    sums->add(image);
    if (pass + 1 < fewest_passes) continue;
    error_db = sums->median_error_db();
    if (progress != nullptr) progress->measured("trace", "median_error_db", error_db);
    if (error_db <= goal.median_error_db) break;
  }
  const std::uint32_t passes = sums->passes();
  TracedToError traced = std::move(*sums).result();
  traced.median_error_db = error_db;
  traced.samples_per_cell = passes * goal.samples_a_pass;
  return traced;
}

}  // namespace sigmascape::simulate
