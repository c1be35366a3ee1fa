#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace sigmascape::product {

/// A document as `json_text` writes it, an object of which no more than a member, or of a long list an element, is in
/// memory.
class JsonStream {
 public:
  using Json = nlohmann::ordered_json;
  /// Takes the text, piece after piece.
  using Sink = std::function<void(std::string_view piece)>;

  explicit JsonStream(Sink write) : write_(std::move(write)) { write_("{"); }

  void member(std::string_view name, const Json& value);
  /// A member whose elements follow, up to the list's end.
  void begin_list(std::string_view name);
  void element(const Json& value);
  void end_list();
  /// Nothing may be added afterwards.
  void end();

 private:
  void begin_member(std::string_view name);

  Sink write_;
  bool has_members_ = false, has_elements_ = false;
};

}  // namespace sigmascape::product
