#include "polarization_option.h"

#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::cli {

void add_polarization_option(CLI::App& command, radar::Polarization& polarization) {
  command.add_option("--polarization", polarization, "vv, hh, hv, vh, or sum for VV + HH + 2 HV")
      ->transform(CLI::CheckedTransformer(radar::polarization_words(), CLI::ignore_case));
}

}  // namespace sigmascape::cli
