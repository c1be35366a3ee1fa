#pragma once

#include <span>
#include <string>

#include "sigmascape/radar/radar.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::python {

/// Tells Python, as UserWarning, what whoever maps with this radar should know (simulate::map_warnings). Called with or
/// without the interpreter's lock. Throws what a filter makes of a warning.
void warn_of(const radar::Radar& radar, std::span<const std::string> warnings);
/// The same of scene::warnings_of().
void warn_of(const scene::Scene& scene);

}  // namespace sigmascape::python
