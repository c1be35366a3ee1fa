#include "sigmascape/product/map_view.h"

#include "sigmascape/product/map_file.h"

namespace sigmascape::product {

const MappedQuantity& sigma0_quantity() {
  static constexpr MappedQuantity quantity{.name = "sigma0",
                                           .decibel_name = "sigma0_db",
                                           .words = "sigma0, linear, with respect to horizontal area",
                                           .decibel_words = "sigma0 in dB, with respect to horizontal area",
                                           .tag = "sigma0 with respect to horizontal area, linear power",
                                           .decibel_tag = "sigma0 with respect to horizontal area, dB",
                                           .unit = "",
                                           .decibel_unit = "dB",
                                           .darkest_db = darkest_db,
                                           .has_correlation = true};
  return quantity;
}

const MappedQuantity& power_quantity() {
  static constexpr MappedQuantity quantity{
      .name = "power_w",
      .decibel_name = "power_dbw",
      .words = "mean power of one compressed pulse at the antenna's terminals, W",
      .decibel_words = "mean power of one compressed pulse at the antenna's terminals, dBW",
      .tag = "mean power of one compressed pulse at the antenna's terminals, W",
      .decibel_tag = "mean power of one compressed pulse at the antenna's terminals, dBW",
      .unit = "W",
      .decibel_unit = "dBW",
      .darkest_db = darkest_dbw,
      .has_correlation = false};
  return quantity;
}

}  // namespace sigmascape::product
