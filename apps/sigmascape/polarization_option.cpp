#include "polarization_option.h"

#include "word_option.h"

#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::cli {

Option add_polarization_option(Command command, radar::Polarization& polarization, const std::string& usual) {
  return add_word_option(command, "--polarization", polarization, radar::polarization_words(),
                         "vv, hh, hv, vh, or sum for VV + HH + 2 HV; unless stated " +
                             (usual.empty() ? radar::polarization_word(polarization) : usual));
}

}  // namespace sigmascape::cli
