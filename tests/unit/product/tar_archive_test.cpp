#include "sigmascape/product/tar_archive.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

#include "scratch_folder.h"

namespace sigmascape::product {
namespace {

TEST(TarArchive, IsUnpackedByTar) {
  const ScratchFolder folder;
  std::string bytes;
  TarArchive tar([&](std::string_view piece) { bytes += piece; });
  const std::string content(1300, 'x');
  tar.add("000001.map.npy", content);
  tar.add("000001.metadata.json", "{}\n");
  tar.end();
  EXPECT_EQ(bytes.size() % 512, 0U);
  folder.write("a.tar", bytes);
  ASSERT_EQ(std::system(fmt::format("cd '{0}' && tar -xf a.tar", folder.path("").string()).c_str()), 0);
  std::filesystem::remove(folder.path("a.tar"));
  const std::map<std::string, std::string> expected{{"000001.map.npy", content}, {"000001.metadata.json", "{}\n"}};
  EXPECT_EQ(difference_of(files_of(folder.path("")), expected), "");
}

TEST(TarArchive, RefusesNamesThatDoNotFit) {
  TarArchive tar([](std::string_view) {});
  EXPECT_NE(message_of_error([&] { tar.add(std::string(101, 'n'), ""); }).find("100 characters"), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::product
