#include "sigmascape/receiver/power_bins.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "sigmascape/receiver/fixed_point_sum.h"

namespace sigmascape::receiver {
namespace {

constexpr double units_per_m2 = 0x1p36;

/// Adds to the sums of a bin, for one thread at a time. Returns how many of the channels do not fit.
std::uint64_t add_channels(std::int64_t* units, std::uint32_t* rests, const radar::Channels& rcs_m2) {
  std::uint64_t overflows = 0;
  for (const float value : {rcs_m2.vv, rcs_m2.hh, rcs_m2.hv, rcs_m2.re_vvhh})
    overflows += add_finely_alone(*units++, *rests++, static_cast<double>(value) * units_per_m2) ? 0 : 1;
  return overflows;
}

}  // namespace

void PowerLine::add(std::size_t bin, const radar::Channels& rcs_m2) {
  const std::size_t number = bin * radar::Channels::count;
  overflows_ += add_channels(&units_[number], &rests_[number], rcs_m2);
  first_ = std::min(first_, bin);
  end_ = std::max(end_, bin + 1);
}

void PowerLine::add_shared(double place, const radar::Channels& rcs_m2) {
  const double left = std::floor(place - 0.5);
  const auto right_share = static_cast<float>(place - 0.5 - left);
  const std::size_t count = units_.size() / radar::Channels::count;
  const auto bins = static_cast<double>(count);
  if (left >= 0.0 && left < bins) add(static_cast<std::size_t>(left), rcs_m2 * (1.0F - right_share));
  if (left >= -1.0 && left + 1.0 < bins) add(static_cast<std::size_t>(left + 1.0), rcs_m2 * right_share);
}

/// A row that no other thread adds to while this lives. It is held for some nanoseconds, many times more briefly than
/// each of the numbers takes that atomic additions would need, and hardly ever wanted twice.
class PowerBins::HeldRow {
 public:
  HeldRow(PowerBins& bins, std::size_t row) : lock_((*bins.locks_)[row % locks].is_held) {
    while (lock_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  ~HeldRow() { lock_.clear(std::memory_order_release); }
  HeldRow(const HeldRow&) = delete;
  HeldRow& operator=(const HeldRow&) = delete;

 private:
  std::atomic_flag& lock_;
};

PowerBins::PowerBins(std::size_t columns, std::size_t rows)
    : columns_(columns),
      rows_(rows),
      units_(columns * rows * radar::Channels::count, 0),
      rests_(units_.size(), 0),
      locks_(std::make_unique<std::array<RowLock, locks>>()) {}

void PowerBins::clear() {
  std::ranges::fill(units_, 0);
  std::ranges::fill(rests_, 0U);
  overflows_ = 0;
}

void PowerBins::add_to_held(std::size_t column, std::size_t row, const radar::Channels& rcs_m2) {
  const std::size_t number = (row * columns_ + column) * radar::Channels::count;
  const std::uint64_t overflows = add_channels(&units_[number], &rests_[number], rcs_m2);
  if (overflows > 0) std::atomic_ref(overflows_).fetch_add(overflows, std::memory_order_relaxed);
}

void PowerBins::add(std::size_t column, std::size_t row, const radar::Channels& rcs_m2) {
  const HeldRow held(*this, row);
  add_to_held(column, row, rcs_m2);
}

void PowerBins::add_column(std::size_t column, const PowerLine& line) {
  for (std::size_t row = line.first_; row < line.end_; ++row) {
    const HeldRow held(*this, row);
    for (std::size_t channel = 0; channel < radar::Channels::count; ++channel) {
      const std::size_t to = (row * columns_ + column) * radar::Channels::count + channel;
      const std::size_t from = row * radar::Channels::count + channel;
      if (!add_sum_alone(units_[to], rests_[to], line.units_[from], line.rests_[from]))
        std::atomic_ref(overflows_).fetch_add(1, std::memory_order_relaxed);
    }
  }
  if (line.overflows_ > 0) std::atomic_ref(overflows_).fetch_add(line.overflows_, std::memory_order_relaxed);
}

void PowerBins::add_shared(double column, double row, const radar::Channels& rcs_m2) {
  const double left = std::floor(column - 0.5), top = std::floor(row - 0.5);
  const auto right_share = static_cast<float>(column - 0.5 - left);
  const auto lower_share = static_cast<float>(row - 0.5 - top);
  for (int down = 0; down < 2; ++down) {
    const double r = top + down;
    if (!(r >= 0.0 && r < static_cast<double>(rows_))) continue;
    const auto of_row = static_cast<std::size_t>(r);
    const HeldRow held(*this, of_row);
    for (int across = 0; across < 2; ++across) {
      const double c = left + across;
      if (!(c >= 0.0 && c < static_cast<double>(columns_))) continue;
      const float share =
          (across == 1 ? right_share : 1.0F - right_share) * (down == 1 ? lower_share : 1.0F - lower_share);
      add_to_held(static_cast<std::size_t>(c), of_row, rcs_m2 * share);
    }
  }
}

double PowerBins::in_m2(std::size_t number) const {
  return (static_cast<double>(units_[number]) + static_cast<double>(rests_[number]) / parts_a_unit) / units_per_m2;
}

radar::Channels PowerBins::sum(std::size_t column, std::size_t row) const {
  const std::size_t bin = (row * columns_ + column) * radar::Channels::count;
  const auto m2 = [&](std::size_t channel) { return static_cast<float>(in_m2(bin + channel)); };
  return {m2(0), m2(1), m2(2), m2(3)};
}

Array2D<radar::Channels> PowerBins::sums() const {
  Array2D<radar::Channels> sums(columns_, rows_);
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) sums(column, row) = sum(column, row);
  }
  return sums;
}

std::array<double, radar::Channels::count> PowerBins::total() const {
  std::array<double, radar::Channels::count> total{};
  for (std::size_t i = 0; i < units_.size(); ++i) total[i % radar::Channels::count] += in_m2(i);
  return total;
}

}  // namespace sigmascape::receiver
