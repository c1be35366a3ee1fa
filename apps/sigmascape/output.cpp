#include "output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::cli {

void flush_standard_output() {
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0) return;
  // When an earlier write failed, its reason is not known any more.
  const std::string reason = is_flushed ? "" : fmt::format(" ({})", std::strerror(errno));
  throw Error("standard output", "cannot be written" + reason, "send it to where there is room");
}

void Output::finish(const std::string& text, const nlohmann::ordered_json& summary) const {
  // Names of files may be of any bytes, which JSON may not.
  const std::string written =
      json ? summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) : text;
  std::fputs((written + "\n").c_str(), stdout);
  flush_standard_output();
}

}  // namespace sigmascape::cli
