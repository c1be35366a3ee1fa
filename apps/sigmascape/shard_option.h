#pragma once

#include <string>

#include "command_parser.h"

#include "sigmascape/bake/shard.h"
#include "sigmascape/base/error.h"

namespace sigmascape::cli {

/// Adds --shard, which takes what bake::shard_from understands. `doing` is "bake" or "make".
inline Option add_shard_option(Command command, std::string& shard, const std::string& doing) {
  const auto fault = [](const std::string& word) -> std::string {
    try {
      static_cast<void>(bake::shard_from(word));
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  return command
      .add_option("--shard", shard, doing + " one of several equal shares, counted from 0: 2/8 is the third of eight")
      .capture_default_str()
      .check({fault, ""});
}

}  // namespace sigmascape::cli
