#pragma once

#include "command_parser.h"
#include "number_within.h"

#include "sigmascape/base/parallel.h"

namespace sigmascape::cli {

/// Adds --threads.
inline Option add_threads_option(Command command, unsigned& threads) {
  return command.add_option("--threads", threads, "0: one a processor")
      .capture_default_str()
      .check(count_within(0U, most_threads));
}

}  // namespace sigmascape::cli
