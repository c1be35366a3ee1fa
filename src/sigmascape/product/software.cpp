#include "sigmascape/product/software.h"

namespace sigmascape::product {

std::string software_version() {
  return SIGMASCAPE_VERSION;
}

std::string software_name() {
  return "Sigmascape " + software_version();
}

}  // namespace sigmascape::product
