#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "sigmascape/atlas/store.h"

namespace sigmascape::bake {

/// Keeps processes that bake into one folder at once from doing the same job twice.
///
/// Each job, after them the ground of each patch, and last the terrain, is a byte of the empty file ".claims" in that
/// folder, and whoever bakes it holds a lock on that byte. Locks end with the process that holds them, however it ends.
/// Only a server of NFS 3 keeps those of a machine that died until that is back: then the file may be deleted, and who
/// waits notices. Nothing depends on them but time: where a file system cannot lock, or keeps the locks of
/// each host to itself, a job may be baked twice, to the same bytes.
/// Bakes and `sigmascape atlas terrain` alike make the terrain with its claim in hand.
class Claims {
 public:
  /// The right to do one job, given back when it goes out of scope.
  class Claim {
   public:
    Claim(Claim&& other) noexcept : claims_(std::exchange(other.claims_, nullptr)), job_(other.job_) {}
    Claim& operator=(Claim&&) = delete;
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim();

   private:
    friend class Claims;
    Claim(const Claims* claims, std::size_t job) : claims_(claims), job_(job) {}
    const Claims* claims_;
    std::size_t job_;
  };

  explicit Claims(const std::filesystem::path& folder);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  /// Claims job number `job`; nothing when another has it.
  [[nodiscard]] std::optional<Claim> take_if_free(std::size_t job) const;
  /// Claims job number `job`, if another has it as soon as it is free, and calls `while_waiting`, if given, many times
  /// a second until then. Throws Interrupted when this thread is told to stop while it waits.
  [[nodiscard]] Claim take(std::size_t job, const std::function<void()>& while_waiting = {}) const;

 private:
  /// Goes over to the file that lies there now, when it is another than that whose bytes are asked for.
  void renew_if_deleted() const;

  std::filesystem::path file_;
  int descriptor_;
};

/// The number of the claim to an atlas' terrain.
[[nodiscard]] std::size_t terrain_claim(const atlas::AtlasDescription& description);

}  // namespace sigmascape::bake
