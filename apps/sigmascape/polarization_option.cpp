#include "polarization_option.h"

#include "word_option.h"

#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::cli {

void add_polarization_option(CLI::App& command, radar::Polarization& polarization) {
  takes_words(command.add_option("--polarization", polarization, "vv, hh, hv, vh, or sum for VV + HH + 2 HV"),
              radar::polarization_words());
}

}  // namespace sigmascape::cli
