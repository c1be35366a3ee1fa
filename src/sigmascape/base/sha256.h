#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace sigmascape {

/// A running SHA-256 (FIPS 180-4) over whatever is fed to it.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
  /// Feeds the bytes of values without padding in them (numbers, vectors of numbers).
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void add_values(std::span<const T> values) { add(std::as_bytes(values)); }
  template <typename T>
  requires std::is_arithmetic_v<T>
  void add_value(T value) { add(std::as_bytes(std::span(&value, 1))); }

  /// The digest in lower-case hexadecimal; nothing may be added afterwards.
  [[nodiscard]] std::string hex_digest();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Digest of bytes that are at hand.
[[nodiscard]] std::string sha256_of(std::string_view bytes);

/// Digest of a whole file. Throws Error when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace sigmascape
