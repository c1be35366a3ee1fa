#pragma once

#include "command_parser.h"

#include "sigmascape/radar/channels.h"

namespace sigmascape::cli {

/// Adds --polarization vv|hh|hv|vh|sum.
Option add_polarization_option(Command command, radar::Polarization& polarization);

}  // namespace sigmascape::cli
