#pragma once

#include <string_view>
#include <vector>

#include "sigmascape/scatter/permittivity.h"

namespace sigmascape::scatter {

/// A row of ITU-R P.2040, Table 3.
struct ItuMaterial {
  enum class Revision {
    P2040_3,  ///< seen in two independent transcriptions
    P2040_4,  ///< seen in one transcription only: not verified
  };

  std::string_view name;  ///< with the lowest frequency added where a material has a second row
  Revision revision;
  FrequencyRange frequencies;
  PowerLawPermittivity law;

  [[nodiscard]] bool verified() const { return revision == Revision::P2040_3; }
  [[nodiscard]] std::string_view source() const;
};

/// Every material of the Recommendation. docs/physics/permittivity.md, Table 1.
[[nodiscard]] const std::vector<ItuMaterial>& itu_p2040();

}  // namespace sigmascape::scatter
