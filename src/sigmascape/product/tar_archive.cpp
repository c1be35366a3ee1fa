#include "sigmascape/product/tar_archive.h"

#include <array>
#include <cstring>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

constexpr std::size_t block = 512, longest_name = 100;
constexpr std::size_t longest_content = std::size_t{8} << 30U;

/// Fields of a header as the standard lays them out: where each begins and how long it is.
struct Field {
  std::size_t begin, length;
};
constexpr Field name_field{0, 100}, mode_field{100, 8}, owner_field{108, 8}, group_field{116, 8}, size_field{124, 12},
    time_field{136, 12}, sum_field{148, 8}, magic_field{257, 8};
constexpr std::size_t type_place = 156;

using Header = std::array<char, block>;

void put(Header& header, Field field, std::string_view text) {
  std::memcpy(header.data() + field.begin, text.data(), text.size());
}

void put_octal(Header& header, Field field, std::size_t number) {
  put(header, field, fmt::format("{:0{}o}", number, field.length - 1));
}

/// Counted with the field of the sum itself full of blanks.
std::size_t sum_of(const Header& header) {
  std::size_t sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  return sum;
}

}  // namespace

void TarArchive::add(std::string_view name, std::string_view content) {
  if (name.size() > longest_name || content.size() >= longest_content) {
    throw Error(fmt::format("tar file, entry {}", name), "is too large or its name too long",
                "keep names to 100 characters and files below 8 GiB");
  }
  Header header{};
  put(header, name_field, name);
  put_octal(header, mode_field, 0644);
  put_octal(header, owner_field, 0);
  put_octal(header, group_field, 0);
  put_octal(header, size_field, content.size());
  put_octal(header, time_field, 0);
  put(header, sum_field, "        ");
  header[type_place] = '0';
  put(header, magic_field, std::string_view("ustar\00000", 8));
  put(header, sum_field, fmt::format("{:06o}{} ", sum_of(header), '\0'));
  write_({header.data(), header.size()});
  write_(content);
  write_(std::string((block - content.size() % block) % block, '\0'));
}

void TarArchive::end() {
  write_(std::string(2 * block, '\0'));
}

}  // namespace sigmascape::product
