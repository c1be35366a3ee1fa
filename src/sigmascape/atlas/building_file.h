#pragma once

#include <optional>
#include <string_view>

#include "sigmascape/atlas/buildings.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The buildings of an atlas that keeps them apart: `buildings.glb` in its folder, binary glTF 2.0, and the item beside
/// it that vouches for it, `buildings.json`. One mesh, a primitive a material, under a node that turns east, north, up
/// into glTF's axes; each material names in its extras the accessor of what it returns at each frequency, four floats
/// (vv, hh, hv, Re⟨S_VV S_HH*⟩) a node of radar::FaceReflectivity, and that of the nodes' angles. docs/store.md.
inline constexpr std::string_view buildings_name = "buildings.glb";

/// The setting of a store whose buildings are kept apart, and what it says then.
inline constexpr const char* buildings_setting = "buildings";
inline constexpr const char* buildings_apart = "apart";

[[nodiscard]] bool keeps_buildings_apart(const AtlasDescription& description);

/// Writes them, sorted by material, and their item. The same buildings give the same bytes. Throws Error when a file
/// cannot be written.
void write_buildings(const Store& atlas, const Buildings& buildings);

/// What is wrong with the file or its item, if anything.
[[nodiscard]] std::optional<StoreFault> buildings_fault(const Store& atlas, Scrutiny scrutiny);

/// Throws Error when the file is not there or not as its item says.
[[nodiscard]] Buildings read_buildings(const Store& atlas);

}  // namespace sigmascape::atlas
