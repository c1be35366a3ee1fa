#include "sigmascape/atlas/patch_table.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <fmt/format.h>
#include <iterator>
#include <mutex>
#include <numeric>
#include <pthread.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::atlas {
namespace {

/// Of all tables: held as long as one is looked through or filled, never while files are read.
std::mutex looking_and_filling;

/// Forks wait for it, so that a child finds it free and no table half filled.
[[maybe_unused]] const int kept_from_forks = ::pthread_atfork(
    [] { looking_and_filling.lock(); }, [] { looking_and_filling.unlock(); }, [] { looking_and_filling.unlock(); });

/// The turn of one who reads. A child that was forked off has none of the threads that had one, and does not wait.
class Turn {
 public:
  explicit Turn(std::atomic<pid_t>& taken_in) : taken_in_(taken_in) {
    while (!is_had()) {
      Interruption::heed();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  ~Turn() { taken_in_ = 0; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  bool is_had() {
    pid_t before = taken_in_;
    return before != here_ && taken_in_.compare_exchange_strong(before, here_);
  }

  const pid_t here_ = ::getpid();
  std::atomic<pid_t>& taken_in_;
};

/// Goes on below the stored levels, from 256 texels a side down to one. Means are not brighter than the brightest, so
/// the scale fits on.
void add_levels_down_to_one(HalfTexture& texture) {
  const HalfTexture last{texture.side >> (texture.levels.size() - 1), texture.scale, {texture.levels.back()}};
  HalfTexture rest = encoded(mip_chain(decoded(last).front(), 1), texture.scale, 10);
  texture.levels.insert(texture.levels.end(), std::make_move_iterator(rest.levels.begin() + 1),
                        std::make_move_iterator(rest.levels.end()));
}

/// Puts one look of a level among the others.
void place(const std::vector<Half>& texels, std::vector<Half>& level, std::size_t look, std::size_t looks) {
  for (std::size_t texel = 0; texel < texels.size() / texel_halves; ++texel)
    std::copy_n(&texels[texel * texel_halves], texel_halves, &level[(texel * looks + look) * texel_halves]);
}

}  // namespace

PatchTable::PatchTable(Store store, std::vector<LookIndex> looks, std::size_t finest_level, unsigned threads)
    : store_(std::move(store)),
      looks_(std::move(looks)),
      finest_level_(finest_level),
      threads_(threads),
      block_(store_.description().patches.block_over(store_.description().extent)),
      patches_(block_.size()) {
  const auto all_levels = static_cast<std::size_t>(std::bit_width(store_.description().patches.texels_per_side));
  if (finest_level >= all_levels) {
    throw Error("finest level", fmt::format("{} is not in this atlas", finest_level),
                fmt::format("give 0 to {}", all_levels - 1));
  }
  levels_ = all_levels - finest_level;
  for (PatchTexels& patch : patches_) patch.levels.resize(levels_);
}

std::size_t PatchTable::halves_of(std::size_t level) const {
  const std::size_t side = store_.description().patches.texels_per_side >> level;
  return side * side * looks_.size() * texel_halves;
}

/// Those of the table that are wanted and whose levels from `first`, counted from the finest that is held, are not
/// there.
std::vector<std::size_t> PatchTable::missing(const PatchBlock& wanted, std::size_t first) const {
  const auto is_wanted = [&](PatchIndex patch) {
    return patch.x >= wanted.south_west.x && patch.x <= wanted.north_east.x && patch.y >= wanted.south_west.y &&
           patch.y <= wanted.north_east.y;
  };
  std::vector<std::size_t> numbers;
  const std::scoped_lock lock(looking_and_filling);
  for (std::size_t number = 0; number < patches_.size(); ++number) {
    if (is_wanted(block_[number]) && patches_[number].levels[first].empty()) numbers.push_back(number);
  }
  return numbers;
}

/// Better one sentence at once than a failure after minutes of reading.
void PatchTable::check_whole(const std::vector<std::size_t>& numbers) const {
  std::vector<StoreFault> faults;
  for (const std::size_t number : numbers) {
    Interruption::heed();
    for (const LookIndex look : looks_) {
      if (auto fault = texture_fault(store_, store_.texture_path(block_[number], look), Scrutiny::Size))
        faults.push_back(std::move(*fault));
    }
  }
  if (faults.empty()) return;
  throw Error((store_.folder() / faults.front().file).string(),
              fmt::format("{}; {} of {} textures are not there or not whole", faults.front().what, faults.size(),
                          numbers.size() * looks_.size()),
              "finish the bake by starting it again with the same settings");
}

void PatchTable::check_whole() const {
  std::vector<std::size_t> all(patches_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  check_whole(all);
}

void PatchTable::check_room(const std::vector<std::size_t>& numbers, std::size_t first) const {
  double bytes = static_cast<double>(memory_bytes());
  for (std::size_t level = first; level < levels_; ++level)
    bytes += static_cast<double>(numbers.size()) * static_cast<double>(halves_of(finest_level_ + level) * sizeof(Half));
  if (const double memory_bytes = machine_memory_bytes(); bytes > memory_bytes) {
    throw Error(store_.folder().string(),
                fmt::format("is asked for textures of {} patches and {} looks that take {:.3g} GB of memory, and there "
                            "are {:.3g}",
                            numbers.size(), looks_.size(), bytes / 1e9, memory_bytes / 1e9),
                "map a smaller area or coarser cells, or take live frames, which read what they look at");
  }
}

void PatchTable::read(const PatchBlock& wanted, std::size_t from_level) {
  const std::size_t first = std::max(from_level, finest_level_) - finest_level_;
  if (missing(wanted, first).empty()) return;
  const Turn turn(read_in_);
  // Whoever had the turn before may have read it.
  const std::vector<std::size_t> numbers = missing(wanted, first);
  if (numbers.empty()) return;
  check_whole(numbers);
  check_room(numbers, first);
  const std::size_t looks = looks_.size();
  // What is there already others may be looking at: only what is new is filled, and shown when it is whole.
  std::vector<PatchTexels> fresh(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::vector<std::vector<Half>>& held = patches_[numbers[i]].levels;
    fresh[i].scales.resize(looks);
    fresh[i].levels.resize(levels_);
    for (std::size_t level = first; level < levels_; ++level) {
      if (held[level].empty()) fresh[i].levels[level].resize(halves_of(finest_level_ + level));
    }
  }
  parallel_for(numbers.size() * looks, threads_, [&](std::size_t index, unsigned) {
    const std::size_t look = index % looks;
    PatchTexels& patch = fresh[index / looks];
    HalfTexture texture = store_.read_halves(block_[numbers[index / looks]], looks_[look]);
    add_levels_down_to_one(texture);
    patch.scales[look] = static_cast<float>(texture.scale);
    for (std::size_t level = 0; level < levels_; ++level) {
      if (!patch.levels[level].empty()) place(texture.levels[finest_level_ + level], patch.levels[level], look, looks);
    }
  });
  fill(numbers, fresh, first);
}

void PatchTable::fill(const std::vector<std::size_t>& numbers, std::vector<PatchTexels>& fresh, std::size_t first) {
  const std::scoped_lock lock(looking_and_filling);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    PatchTexels& patch = patches_[numbers[i]];
    if (patch.scales.empty()) patch.scales = std::move(fresh[i].scales);
    for (std::size_t level = first; level < levels_; ++level) {
      if (patch.levels[level].empty()) patch.levels[level] = std::move(fresh[i].levels[level]);
    }
  }
}

std::size_t PatchTable::memory_bytes() const {
  std::size_t bytes = 0;
  const std::scoped_lock lock(looking_and_filling);
  for (const PatchTexels& patch : patches_) {
    for (const std::vector<Half>& level : patch.levels) bytes += level.size() * sizeof(Half);
  }
  return bytes;
}

}  // namespace sigmascape::atlas
