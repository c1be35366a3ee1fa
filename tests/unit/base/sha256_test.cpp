#include "sigmascape/base/sha256.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"

namespace sigmascape {
namespace {

std::string digest_of(std::string_view text) {
  Sha256 sha;
  sha.add(text);
  return sha.hex_digest();
}

// Examples that go with FIPS 180-4.
TEST(Sha256, StandardMessages) {
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest_of(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesMakeTheWhole) {
  Sha256 sha;
  for (const char* piece : {"a", "", "b", "c"}) sha.add(std::string_view(piece));
  EXPECT_EQ(sha.hex_digest(), digest_of("abc"));
}

TEST(Sha256, ValuesAreTheirBytes) {
  const std::vector<std::uint16_t> values{0x6261, 0x6463};  // little-endian "abcd"
  Sha256 many, single;
  many.add_values(std::span<const std::uint16_t>(values));
  single.add_value(std::uint32_t{0x64636261});
  EXPECT_EQ(many.hex_digest(), digest_of("abcd"));
  EXPECT_EQ(single.hex_digest(), digest_of("abcd"));
}

TEST(Sha256OfFile, DigestsAllBytes) {
  const ScratchFolder folder;
  // Longer than one read, and not a multiple of it.
  const std::string text(200'001, 'x');
  EXPECT_EQ(sha256_of_file(folder.write("long", text)), digest_of(text));
  EXPECT_EQ(sha256_of_file(folder.write("empty", "")), digest_of(""));
}

TEST(Sha256OfFile, MissingFileIsAnError) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(sha256_of_file(folder.path("none"))); }),
              ::testing::HasSubstr("none: cannot be read"));
}

// A stream opens a folder, and reads nothing of it.
TEST(Sha256OfFile, WhatCannotBeReadToItsEndIsAnError) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("folder"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(sha256_of_file(folder.path("folder"))); }),
              ::testing::HasSubstr("folder: cannot be read to its end"));
}

}  // namespace
}  // namespace sigmascape
