#include "polarization_option.h"

#include <map>

namespace sigmascape::cli {

void add_polarization_option(CLI::App& command, radar::Polarization& polarization) {
  static const std::map<std::string, radar::Polarization> words{{"vv", radar::Polarization::VV},
                                                                {"hh", radar::Polarization::HH},
                                                                {"hv", radar::Polarization::HV},
                                                                {"vh", radar::Polarization::VH},
                                                                {"sum", radar::Polarization::Sum}};
  command.add_option("--polarization", polarization, "vv, hh, hv, vh, or sum for VV + HH + 2 HV")
      ->transform(CLI::CheckedTransformer(words, CLI::ignore_case));
}

}  // namespace sigmascape::cli
