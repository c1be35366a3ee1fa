#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sigmascape::live {

/// What one thread replaces while others read it as it stands. Who reads waits for nobody, whatever the one who
/// replaces is doing or has stopped in the middle of, and takes no memory
/// (docs/decisions/0121-frames-take-no-locks.md).
///
/// A reader counts itself among those of the newest version and then looks whether that still is the newest. If so, who
/// replaces it will find the reader counted; if not, another version has come meanwhile, and the reader begins anew. A
/// version that was replaced is filled again once its count is zero, never given back: the count can be touched
/// late without harm. All steps are sequentially consistent: of "count, then look which is the newest" and "replace the
/// newest, then look at the count" one has to see the other.
template <typename Value>
class Published {
  struct Version {
    std::atomic<std::size_t> readers{0};
    Value value;
  };
  static_assert(std::atomic<std::size_t>::is_always_lock_free && std::atomic<Version*>::is_always_lock_free);

 public:
  explicit Published(Value value) { store(std::move(value)); }
  /// Nobody may read any more.
  ~Published() {
    assert(std::ranges::all_of(versions_, [](const auto& version) { return version->readers.load() == 0; }));
  }
  Published(const Published&) = delete;
  Published& operator=(const Published&) = delete;

  /// One version, which stays as it is until this and all its copies are gone.
  class Reading {
   public:
    Reading() = default;
    Reading(const Reading& other) : version_(other.version_) {
      if (version_ != nullptr) version_->readers.fetch_add(1);
    }
    Reading(Reading&& other) noexcept : version_(std::exchange(other.version_, nullptr)) {}
    Reading& operator=(Reading other) noexcept {
      std::swap(version_, other.version_);
      return *this;
    }
    ~Reading() {
      if (version_ != nullptr) version_->readers.fetch_sub(1);
    }

    [[nodiscard]] const Value& operator*() const { return version_->value; }
    [[nodiscard]] const Value* operator->() const { return &version_->value; }

   private:
    friend class Published;
    explicit Reading(Version* counted) : version_(counted) {}

    Version* version_ = nullptr;
  };

  /// The newest version. Any thread, at any time.
  [[nodiscard]] Reading load() const {
    while (true) {
      Version* const version = newest_.load();
      version->readers.fetch_add(1);
      if (newest_.load() == version) return Reading(version);
      version->readers.fetch_sub(1);
    }
  }

  // The rest is for one thread at a time.

  [[nodiscard]] const Value& newest() const { return newest_.load()->value; }

  void store(Value value) {
    const auto unread = std::ranges::find_if(versions_, [this](const auto& version) { return is_unread(*version); });
    Version& next = unread != versions_.end() ? **unread : *versions_.emplace_back(std::make_unique<Version>());
    next.value = std::move(value);
    newest_.store(&next);
  }

  /// Lets go of what versions hold that were replaced and are not read any more.
  void forget_unread() {
    for (const auto& version : versions_) {
      if (is_unread(*version)) version->value = Value();
    }
  }

 private:
  [[nodiscard]] bool is_unread(const Version& version) const {
    return &version != newest_.load() && version.readers.load() == 0;
  }

  std::atomic<Version*> newest_{nullptr};
  std::vector<std::unique_ptr<Version>> versions_;  // as many as were read at once, and two
};

}  // namespace sigmascape::live
