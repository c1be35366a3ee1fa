#include "sigmascape/base/machine_memory.h"

#include <unistd.h>

namespace sigmascape {

double machine_memory_bytes() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace sigmascape
