#include "sigmascape/product/png_file.h"

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <fmt/format.h>
#include <new>
#include <png.h>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::product {
namespace {

/// Everything libpng is given, made before it starts: it leaves by longjmp, past the destructors of whatever it
/// interrupts.
struct PngContent {
  png_uint_32 width, height;
  bool has_alpha;
  std::vector<png_byte> samples;
  std::vector<png_bytep> rows;
  std::vector<png_text> texts;
};

bool is_keyword(const std::string& key) {
  return !key.empty() && key.size() <= 79 && key.front() != ' ' && key.back() != ' ' &&
         std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// libpng wants pointers to mutable characters but does not change them.
png_text text_chunk(const std::string& key, const std::string& value) {
  png_text chunk{};
  chunk.compression = is_ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  chunk.key = const_cast<png_charp>(key.c_str());
  chunk.text = const_cast<png_charp>(value.c_str());
  return chunk;
}

PngContent content_of(const Picture& picture) {
  const auto pixels = picture.pixels.values();
  PngContent content{.width = static_cast<png_uint_32>(picture.pixels.columns()),
                     .height = static_cast<png_uint_32>(picture.pixels.rows()),
                     .has_alpha = std::any_of(pixels.begin(), pixels.end(), [](Rgba p) { return p.alpha != 255; }),
                     .samples = {},
                     .rows = {},
                     .texts = {}};
  const std::size_t samples_per_pixel = content.has_alpha ? 4 : 3;
  content.samples.reserve(pixels.size() * samples_per_pixel);
  for (const Rgba pixel : pixels) {
    content.samples.insert(content.samples.end(), {pixel.red, pixel.green, pixel.blue});
    if (content.has_alpha) content.samples.push_back(pixel.alpha);
  }
  for (std::size_t row = 0; row < picture.pixels.rows(); ++row) {
    content.rows.push_back(content.samples.data() + row * picture.pixels.columns() * samples_per_pixel);
  }
  for (const auto& [key, value] : picture.metadata) {
    if (!is_keyword(key)) {
      throw Error("picture metadata", fmt::format("'{}' is no PNG keyword", key),
                  "use 1 to 79 printable ASCII characters");
    }
    content.texts.push_back(text_chunk(key, value));
  }
  return content;
}

void append_bytes(png_structp png, png_bytep data, std::size_t length) {
  bool fits = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {
    fits = false;
  }
  if (!fits) png_error(png, "out of memory");
}

void flush_nothing(png_structp) {}

/// Runs libpng over the content; false when it gave up. Holds nothing that a longjmp would leave behind.
bool encode(png_structp png, png_infop info, PngContent& content, std::string& bytes) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &bytes, append_bytes, flush_nothing);
  png_set_IHDR(png, info, content.width, content.height, 8,
               content.has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Speckle does not compress better for filters or for a longer search.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 3);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  if (!content.texts.empty()) png_set_text(png, info, content.texts.data(), static_cast<int>(content.texts.size()));
  png_set_rows(png, info, content.rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

}  // namespace

std::string png_bytes(const Picture& picture) {
  if (picture.pixels.empty()) throw Error("picture", "has no pixels", "make it from a map of at least one cell");
  PngContent content = content_of(picture);
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool done = info != nullptr && encode(png, info, content, bytes);
  png_destroy_write_struct(&png, &info);
  if (!done) {
    throw Error(fmt::format("picture of {} x {} pixels", content.width, content.height), "cannot be encoded as PNG",
                "make it smaller");
  }
  return bytes;
}

std::string world_file_text(const radar::GroundGrid& grid) {
  const Vec2d centre = grid.centre_of(0, 0);
  return fmt::format("{0:.15f}\n0\n0\n-{0:.15f}\n{1:.12f}\n{2:.12f}\n", grid.cell_m, centre.x, centre.y);
}

void check_png_name(const std::filesystem::path& path) {
  if (file_ending(path) != ".png")
    throw Error(path.string(), "is no kind of file that maps are drawn into", "end the name in .png");
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::string bytes = png_bytes(picture);
  const std::string world = world_file_text(picture.grid);
  geo::write_together({{geo::companion_of(path, ".pgw"), world}, {path, bytes}});
}

}  // namespace sigmascape::product
