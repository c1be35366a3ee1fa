#include "sigmascape/product/json_stream.h"

#include <cstddef>
#include <string>

#include "sigmascape/product/json_text.h"

namespace sigmascape::product {
namespace {

/// As it stands so many levels within a document: no string of JSON holds a line's end.
std::string within(std::size_t levels, const JsonStream::Json& value) {
  std::string text;
  for (const char c : json_text(value, 1)) {
    text += c;
    if (c == '\n') text.append(levels, ' ');
  }
  text.resize(text.size() - 1 - levels);  // the end of the last line
  return text;
}

}  // namespace

void JsonStream::member(std::string_view name, const Json& value) {
  begin_member(name);
  write_(within(1, value));
}

void JsonStream::begin_list(std::string_view name) {
  begin_member(name);
  write_("[");
  has_elements_ = false;
}

void JsonStream::element(const Json& value) {
  write_((has_elements_ ? ",\n  " : "\n  ") + within(2, value));
  has_elements_ = true;
}

void JsonStream::end_list() {
  write_(has_elements_ ? "\n ]" : "]");
}

void JsonStream::end() {
  write_(has_members_ ? "\n}\n" : "}\n");
}

void JsonStream::begin_member(std::string_view name) {
  write_((has_members_ ? ",\n " : "\n ") + within(1, name) + ": ");
  has_members_ = true;
}

}  // namespace sigmascape::product
