#pragma once

#include <string>

#include "command_parser.h"

#include "sigmascape/radar/channels.h"

namespace sigmascape::cli {

/// Adds --polarization vv|hh|hv|vh|sum. Unless it is stated what `polarization` holds is taken, or what `usual` tells.
Option add_polarization_option(Command command, radar::Polarization& polarization, const std::string& usual = "");

}  // namespace sigmascape::cli
