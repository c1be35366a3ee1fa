#include "sigmascape/product/zip_bytes.h"

#include <zlib.h>

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

void put16(std::string& bytes, std::size_t number) {
  for (unsigned shift = 0; shift < 16; shift += 8) bytes += static_cast<char>((number >> shift) & 0xffU);
}
void put32(std::string& bytes, std::size_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((number >> shift) & 0xffU);
}

std::size_t checksum(const std::string& content) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size());
}

/// What the header before the content and the one in the directory at the end have in common.
std::string facts(const ZipEntry& entry) {
  constexpr std::size_t version = 20, flags = 0, stored = 0, midnight = 0, january_1980 = 0x21;
  std::string bytes;
  for (const std::size_t field : {version, flags, stored, midnight, january_1980}) put16(bytes, field);
  put32(bytes, checksum(entry.content));
  put32(bytes, entry.content.size());
  put32(bytes, entry.content.size());
  put16(bytes, entry.name.size());
  put16(bytes, 0);
  return bytes;
}

}  // namespace

std::string zip_bytes(const std::vector<ZipEntry>& entries, const std::string& where, const std::string& instead) {
  std::size_t size = 22;
  for (const ZipEntry& entry : entries) size += entry.content.size() + 2 * entry.name.size() + 76;
  if (size > UINT32_MAX) throw Error(where, "would be larger than 4 GiB", instead);

  std::string bytes, directory;
  bytes.reserve(size);
  for (const ZipEntry& entry : entries) {
    directory += std::string("PK\x01\x02\x14\x00", 6) + facts(entry);
    directory.append(10, '\0');
    put32(directory, bytes.size());
    directory += entry.name;
    bytes += "PK\x03\x04" + facts(entry) + entry.name + entry.content;
  }
  const std::size_t begins = bytes.size();
  bytes += directory + std::string("PK\x05\x06\0\0\0\0", 8);
  put16(bytes, entries.size());
  put16(bytes, entries.size());
  put32(bytes, directory.size());
  put32(bytes, begins);
  put16(bytes, 0);
  return bytes;
}

}  // namespace sigmascape::product
