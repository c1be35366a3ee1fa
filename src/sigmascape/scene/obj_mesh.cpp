#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <tiny_obj_loader.h>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/face_triangles.h"
#include "sigmascape/scene/imported_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr std::string_view blanks = " \t\r";
/// Of a faulty line, in an error.
constexpr std::size_t longest_quote = 60;

/// Takes the first line off a text.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

/// The text without the byte-order mark that some editors put before it.
std::string_view without_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

void skip_blanks(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
}

/// Takes the backslash off the end of a line that goes on in the next one; whether it does. A remark ends with its
/// line, whatever that ends on.
bool take_continuation(std::string_view& line) {
  std::string_view words = line.substr(0, line.find_last_not_of('\r') + 1);
  if (!words.ends_with('\\')) return false;
  words.remove_suffix(1);
  const std::string_view cut = words;
  skip_blanks(words);
  if (words.starts_with('#') || words.find(" #") != words.npos) return false;
  line = cut;
  return true;
}

/// The text with every line whole that is continued over several, and as many empty lines after it, so that those that
/// follow keep their numbers.
std::string with_whole_lines(std::string_view text) {
  std::string whole;
  whole.reserve(text.size() + 1);
  for (std::size_t lines = 1; !text.empty(); ++lines) {
    std::string_view line = next_line(text);
    const bool goes_on = take_continuation(line);
    whole += line;
    if (goes_on && !text.empty()) {
      whole += ' ';
    } else {
      whole.append(std::exchange(lines, 0), '\n');
    }
  }
  return whole;
}

/// Takes the first word, none at the end, off a line.
std::string_view next_word(std::string_view& line) {
  skip_blanks(line);
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// Whether a word is one number that single precision, in which the loader counts, can hold.
bool is_coordinate(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stopped, fault] = std::from_chars(word.data(), end, value);
  return fault == std::errc{} && stopped == end &&
         std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

/// Whether a corner of a face begins with a number that the loader, which counts in 32 bits, can hold, or with none.
bool is_within_count(std::string_view corner) {
  int number = 0;
  return std::from_chars(corner.data(), corner.data() + corner.size(), number).ec != std::errc::result_out_of_range;
}

bool holds_coordinates(std::string_view words) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_coordinate(next_word(words))) return false;
  }
  return true;
}

bool holds_numbers_within_count(std::string_view words) {
  for (std::string_view corner = next_word(words); !corner.empty(); corner = next_word(words)) {
    if (!is_within_count(corner)) return false;
  }
  return true;
}

/// The loader takes what it cannot read for 0, and the last digits of what it cannot count for the number. Throws Error
/// that names the first line of a vertex whose three coordinates are not all there as finite numbers, or of a face with
/// such a number of a vertex.
void check_numbers(std::string_view text, const std::filesystem::path& file) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    std::string_view words = line;
    const std::string_view kind = next_word(words);
    const auto faulty = [&](const char* what, const char* remedy) {
      return Error(
          fmt::format("{}:{}", file.string(), number),
          fmt::format("'{}' {}", line.substr(0, std::min(line.find_last_not_of(blanks) + 1, longest_quote)), what),
          remedy);
    };
    if (kind == "v" && !holds_coordinates(words)) {
      throw faulty("does not hold three finite numbers",
                   "write a vertex as v x y z with decimal points, such as v 0.5 1 0");
    }
    if (kind == "f" && !holds_numbers_within_count(words))
      throw faulty("names a vertex beyond those that a file can have", "export it again");
  }
}

/// The name that a line states: neither the blanks around it nor a remark after it.
std::string name_in(std::string_view words) {
  skip_blanks(words);
  words = words.substr(0, words.find(" #"));
  return std::string(words.substr(0, words.find_last_not_of(blanks) + 1));
}

/// Adds the faces of a file to a mesh that has all the file's vertices.
class ObjFaces {
 public:
  ObjFaces(const std::filesystem::path& file, ImportedMesh& mesh) : file_(file.string()), mesh_(mesh) {}

  void pass_vertex() { ++passed_; }
  void begin_object(std::string name) {
    object_ = std::move(name);
    number_ = 0;
  }
  void begin_material(std::string name) {
    material_ = std::move(name);
    of_material_.reset();
  }
  void add(std::span<const tinyobj::index_t> corners) {
    ++number_;
    if (corners.size() < 3) return;
    numbers_.clear();
    places_.clear();
    for (const tinyobj::index_t& corner : corners) {
      numbers_.push_back(vertex_of(corner.vertex_index));
      places_.push_back(mesh_.vertices[numbers_.back()]);
    }
    const auto triangles = triangles_of_face(places_);
    if (!triangles) {
      throw Error(file_, fmt::format("{} has an outline that crosses or meets itself", face_name()),
                  "export it as triangles");
    }
    if (!of_material_) of_material_ = mesh_.material_index(material_);
    for (const auto& [a, b, c] : *triangles) {
      mesh_.triangles.push_back({numbers_[a], numbers_[b], numbers_[c]});
      mesh_.materials.push_back(*of_material_);
    }
  }

 private:
  [[nodiscard]] std::string face_name() const {
    return fmt::format("face {}{}", number_, object_.empty() ? "" : " of " + object_);
  }

  /// Files count vertices from 1, or backwards from the last one before the face.
  [[nodiscard]] std::uint32_t vertex_of(int written) const {
    const std::int64_t index = written < 0 ? passed_ + written : std::int64_t{written} - 1;
    if (index < 0 || index >= static_cast<std::int64_t>(mesh_.vertices.size())) {
      throw Error(file_, fmt::format("{} names vertex {} of {}", face_name(), written, mesh_.vertices.size()),
                  "export it again");
    }
    return static_cast<std::uint32_t>(index);
  }

  std::string file_;
  ImportedMesh& mesh_;
  std::string object_, material_;
  std::optional<std::size_t> of_material_;  ///< where a face of it has been met
  std::int64_t passed_ = 0;                 ///< vertices before this line
  std::size_t number_ = 0;                  ///< of the object's faces
  std::vector<std::uint32_t> numbers_;
  std::vector<Vec3d> places_;
};

void add_vertices(const std::string& text, ImportedMesh& mesh) {
  tinyobj::callback_t met;
  met.vertex_cb = [](void* vertices, float x, float y, float z, float) {
    static_cast<std::vector<Vec3d>*>(vertices)->push_back(Vec3f{x, y, z}.to<double>());
  };
  std::istringstream stream(text);
  tinyobj::LoadObjWithCallback(stream, met, &mesh.vertices);
}

void add_faces(const std::string& text, ObjFaces& faces) {
  tinyobj::callback_t met;
  met.vertex_cb = [](void* to, float, float, float, float) { static_cast<ObjFaces*>(to)->pass_vertex(); };
  met.object_cb = [](void* to, const char* name) { static_cast<ObjFaces*>(to)->begin_object(name_in(name)); };
  met.group_cb = [](void* to, const char** names, int count) {
    const std::span<const char*> words(names, static_cast<std::size_t>(count));
    static_cast<ObjFaces*>(to)->begin_object(fmt::format("{}", fmt::join(words, " ")));
  };
  met.usemtl_cb = [](void* to, const char* name, int) { static_cast<ObjFaces*>(to)->begin_material(name_in(name)); };
  met.index_cb = [](void* to, tinyobj::index_t* corners, int count) {
    static_cast<ObjFaces*>(to)->add({corners, static_cast<std::size_t>(count)});
  };
  std::istringstream stream(text);
  tinyobj::LoadObjWithCallback(stream, met, &faces);
}

}  // namespace

ImportedMesh read_obj(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream buffer;
  buffer << stream.rdbuf();
  if (!stream) throw Error(file.string(), "cannot be read", "check that it is a readable file");
  const std::string content = buffer.str();
  const std::string text = with_whole_lines(without_mark(content));
  check_numbers(text, file);
  ImportedMesh mesh;
  // The loader's own shapes hold no face of more than 255 corners; line by line it has no such limit.
  add_vertices(text, mesh);
  ObjFaces faces(file, mesh);
  add_faces(text, faces);
  return mesh;
}

}  // namespace sigmascape::scene
