#pragma once

#include <CLI/CLI.hpp>

#include "sigmascape/radar/channels.h"

namespace sigmascape::cli {

/// Adds --polarization vv|hh|hv|vh|sum.
void add_polarization_option(CLI::App& command, radar::Polarization& polarization);

}  // namespace sigmascape::cli
