#include "sigmascape/simulate/layers.h"

#include <array>
#include <fmt/format.h>
#include <utility>

#include "sigmascape/base/error.h"

namespace sigmascape::simulate {
namespace {

constexpr std::array<std::pair<LayerKind, std::string_view>, 6> named_kinds{{{LayerKind::Shadow, "shadow"},
                                                                             {LayerKind::Layover, "layover"},
                                                                             {LayerKind::Incidence, "incidence"},
                                                                             {LayerKind::Range, "range"},
                                                                             {LayerKind::Class, "class"},
                                                                             {LayerKind::Height, "height"}}};

}  // namespace

LayerKind layer_kind(std::string_view name) {
  std::string known;
  for (const auto& [kind, word] : named_kinds) {
    if (word == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw Error(fmt::format("layer \"{}\"", name), "is not known", "choose among " + known);
}

std::string_view name_of(LayerKind kind) {
  for (const auto& [known, word] : named_kinds) {
    if (known == kind) return word;
  }
  return "";
}

std::vector<std::string> class_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scatter::Material& material : scene.materials) names.push_back(material.name);
  names.emplace_back("solid object");
  names.emplace_back("crown");
  return names;
}

}  // namespace sigmascape::simulate
