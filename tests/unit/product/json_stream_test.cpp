#include "sigmascape/product/json_stream.h"

#include <gtest/gtest.h>
#include <string>

#include "sigmascape/product/json_text.h"

namespace sigmascape::product {
namespace {

TEST(JsonStream, WritesTheTextOfTheWholeDocument) {
  using Json = JsonStream::Json;
  const Json elements = Json::array({{{"name", "a\nb"}, {"box", {1.5, 2, {"deep", Json::array()}}}}, 7, nullptr});
  std::string text;
  JsonStream json([&](std::string_view piece) { text += piece; });
  json.member("words \" of it", "caf\xe9");
  json.begin_list("list");
  for (const Json& element : elements) json.element(element);
  json.end_list();
  json.begin_list("none");
  json.end_list();
  json.member("object", {{"a", {1, 2}}, {"b", Json::object()}});
  json.end();
  EXPECT_EQ(text, json_text({{"words \" of it", "caf\xe9"},
                             {"list", elements},
                             {"none", Json::array()},
                             {"object", {{"a", {1, 2}}, {"b", Json::object()}}}},
                            1));
}

}  // namespace
}  // namespace sigmascape::product
