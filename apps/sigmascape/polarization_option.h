#pragma once

#include <string>

#include "command_parser.h"

#include "sigmascape/radar/channels.h"

namespace sigmascape::cli {

/// Adds --polarization vv|hh|hv|vh|sum. `usual`: what is taken unless it is stated, for the help.
Option add_polarization_option(Command command, radar::Polarization& polarization, const std::string& usual);

}  // namespace sigmascape::cli
