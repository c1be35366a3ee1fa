#include "sigmascape/live/terrain_windows.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <new>
#include <system_error>
#include <tuple>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

/// Of a turn: four within the bins, four before them, and what comes next.
constexpr std::size_t windows_in_budget = 9;
/// A window this small holds the last level of any pyramid.
constexpr std::size_t least_nodes_per_side = terrain::HeightTile::nodes + 2;

radar::Rectangle clipped(const radar::Rectangle& area, const radar::Rectangle& to) {
  const double west = std::clamp(area.west_m, to.west_m, to.east_m), east = std::clamp(area.east_m, west, to.east_m);
  const double south = std::clamp(area.south_m, to.south_m, to.north_m);
  return {west, south, east, std::clamp(area.north_m, south, to.north_m)};
}

/// Nodes that a lattice over an area has at most, wherever the area lies between them.
double nodes_over(const radar::Rectangle& area, double spacing_m) {
  return (area.width_m() / spacing_m + 3.0) * (area.height_m() / spacing_m + 3.0);
}

}  // namespace

bool GroundWindow::covers(const radar::Rectangle& area) const {
  constexpr double rounding_m = 1e-6;
  return radar::holds(radar::widened(nodes.view().extent(), rounding_m), area);
}

TerrainWindows::TerrainWindows(std::shared_ptr<terrain::TerrainPyramid> pyramid, std::size_t budget_bytes)
    : pyramid_(std::move(pyramid)),
      budget_bytes_(budget_bytes),
      most_nodes_per_side_(std::max(
          least_nodes_per_side,
          static_cast<std::size_t>(
              std::sqrt(static_cast<double>(budget_bytes) / static_cast<double>(windows_in_budget * sizeof(float)))))),
      entries_(Entries()) {
  try {
    maker_ = std::jthread([this] { make_windows(); });
  } catch (const std::system_error&) {
    throw Error("terrain", "gets no thread from the system", "allow more threads");
  }
}

TerrainWindows::~TerrainWindows() {
  {
    const std::lock_guard lock(guard_);
    stopping_ = true;
  }
  wishes_.ring();
}

TerrainWindows::View TerrainWindows::view() {
  View view;
  view.entries_ = entries_.load();
  view.frame_ = frame_.fetch_add(1) + 1;
  return view;
}

const GroundWindow* TerrainWindows::View::find(const WindowWish& wish) const {
  const GroundWindow* best = nullptr;
  const auto distance = [&wish](const GroundWindow& window) {
    return std::tuple(std::abs(window.level - wish.level), window.level, window.error_m);
  };
  for (const auto& window : *entries_) {
    if (window->covers(wish.area) && (best == nullptr || distance(*window) < distance(*best))) best = window.get();
  }
  if (best != nullptr) best->last_wanted.store(frame_, std::memory_order_relaxed);
  return best;
}

WindowWish TerrainWindows::wish_for(int level, const radar::Rectangle& area) const {
  const auto most = static_cast<double>(most_nodes_per_side_ * most_nodes_per_side_);
  WindowWish wish{std::clamp(level, 0, pyramid_->levels() - 1), clipped(area, pyramid_->extent())};
  while (wish.level + 1 < pyramid_->levels() &&
         nodes_over(wish.area, pyramid_->layout().spacing_at(wish.level)) > most) {
    ++wish.level;
  }
  return wish;
}

void TerrainWindows::wait_until_loaded() {
  using namespace std::chrono_literals;
  std::unique_lock lock(guard_);
  while (!request_done_.wait_for(lock, 50ms, [this] { return wishes_.empty() && !busy_; })) {
    lock.unlock();
    Interruption::heed();
    lock.lock();
  }
}

void TerrainWindows::load(std::span<const WindowWish> wanted) {
  Asker caller = asker(wanted.size());
  caller.request(wanted);
  wait_until_loaded();
}

std::size_t TerrainWindows::bytes() const {
  const std::lock_guard lock(guard_);
  std::size_t sum = 0;
  for (const auto& window : entries_.newest()) sum += window->nodes.bytes();
  for (const auto& window : retired_) sum += window->nodes.bytes();
  return sum;
}

void TerrainWindows::make_windows() {
  std::unique_lock lock(guard_);
  while (!stopping_) {
    const std::uint32_t calls = wishes_.calls();
    WindowWish wish;
    if (!next_wish(wish)) {
      request_done_.notify_all();
      lock.unlock();
      wishes_.wait_beyond(calls);
      lock.lock();
      continue;
    }
    busy_ = true;
    lock.unlock();
    auto window = made(wish);
    lock.lock();
    if (window) publish(std::move(window), wish);
    busy_ = false;
    request_done_.notify_all();
  }
}

bool TerrainWindows::next_wish(WindowWish& wish) {
  while (wishes_.take(wish)) {
    const bool there = std::ranges::any_of(entries_.newest(), [&wish](const auto& window) {
      return window->level == wish.level && window->covers(wish.area) && !window->is_worth_another_try();
    });
    if (!there) return true;
  }
  return false;
}

std::shared_ptr<const GroundWindow> TerrainWindows::made(const WindowWish& wish) try {
  auto window = std::make_shared<GroundWindow>(most_nodes_per_side_);
  const terrain::WindowReport report = window->nodes.fill(*pyramid_, with_margin(wish), wish.level);
  window->level = report.level;
  window->error_m = report.error_m;
  if (!report.lacking.empty()) window->try_again_at = std::chrono::steady_clock::now() + pyramid_->patience();
  window->last_wanted = frame_.load();
  return window;
} catch (const std::bad_alloc&) {
  return nullptr;
}

radar::Rectangle TerrainWindows::with_margin(const WindowWish& wish) const {
  const auto most = static_cast<double>(most_nodes_per_side_ * most_nodes_per_side_);
  const double spacing_m = pyramid_->layout().spacing_at(wish.level);
  const radar::Rectangle& whole = pyramid_->extent();
  double margin_m = std::max(0.25 * std::max(wish.area.width_m(), wish.area.height_m()), 8.0 * spacing_m);
  radar::Rectangle area = clipped(radar::widened(wish.area, margin_m), whole);
  while (nodes_over(area, spacing_m) > most && margin_m > spacing_m) {
    margin_m *= 0.5;
    area = clipped(radar::widened(wish.area, margin_m), whole);
  }
  return nodes_over(area, spacing_m) > most ? wish.area : area;
}

void TerrainWindows::publish(std::shared_ptr<const GroundWindow> window, const WindowWish& wish) try {
  entries_.forget_unread();
  std::erase_if(retired_, [](const auto& old) { return old.use_count() == 1; });
  Entries entries = entries_.newest();
  // What lacked tiles then does not stay beside what lacks no more of them now.
  std::erase_if(entries, [&](const auto& old) {
    const bool gives_way =
        old->try_again_at && old->level == window->level && old->error_m >= window->error_m && old->covers(wish.area);
    if (gives_way) retired_.push_back(old);
    return gives_way;
  });
  entries.push_back(std::move(window));
  const auto bytes = [&entries] {
    std::size_t sum = 0;
    for (const auto& entry : entries) sum += entry->nodes.bytes();
    return sum;
  };
  while (entries.size() > 1 && bytes() > budget_bytes_) {
    const auto oldest = std::ranges::min_element(entries.begin(), std::prev(entries.end()), {}, [](const auto& entry) {
      return entry->last_wanted.load(std::memory_order_relaxed);
    });
    retired_.push_back(std::move(*oldest));
    entries.erase(oldest);
  }
  entries_.store(std::move(entries));
} catch (const std::bad_alloc&) {
  // There may be memory when frames ask again.
}

}  // namespace sigmascape::live
