#include "sigmascape/scatter/itu_p2040.h"

namespace sigmascape::scatter {

std::string_view ItuMaterial::source() const {
  return verified() ? "ITU-R P.2040-3, Table 3" : "ITU-R P.2040-4, Table 3, from one transcription; not checked";
}

const std::vector<ItuMaterial>& itu_p2040() {
  using Revision = ItuMaterial::Revision;
  static const std::vector<ItuMaterial> rows{
      {"concrete", Revision::P2040_3, {1e9, 100e9}, {5.24, 0.0, 0.0462, 0.7822}},
      {"brick", Revision::P2040_3, {1e9, 40e9}, {3.91, 0.0, 0.0238, 0.16}},
      {"plasterboard", Revision::P2040_3, {1e9, 100e9}, {2.73, 0.0, 0.0085, 0.9395}},
      {"wood", Revision::P2040_3, {0.001e9, 100e9}, {1.99, 0.0, 0.0047, 1.0718}},
      {"glass", Revision::P2040_3, {0.1e9, 100e9}, {6.31, 0.0, 0.0036, 1.3394}},
      {"glass_220_ghz", Revision::P2040_3, {220e9, 450e9}, {5.79, 0.0, 0.0004, 1.658}},
      {"ceiling_board", Revision::P2040_3, {1e9, 100e9}, {1.48, 0.0, 0.0011, 1.075}},
      {"ceiling_board_220_ghz", Revision::P2040_3, {220e9, 450e9}, {1.52, 0.0, 0.0029, 1.029}},
      {"chipboard", Revision::P2040_3, {1e9, 100e9}, {2.58, 0.0, 0.0217, 0.78}},
      {"plywood", Revision::P2040_3, {1e9, 40e9}, {2.71, 0.0, 0.33, 0.0}},
      {"marble", Revision::P2040_3, {1e9, 60e9}, {7.074, 0.0, 0.0055, 0.9262}},
      {"floorboard", Revision::P2040_3, {50e9, 100e9}, {3.66, 0.0, 0.0044, 1.3515}},
      {"metal", Revision::P2040_3, {1e9, 100e9}, {1.0, 0.0, 10000000.0, 0.0}},
      {"very_dry_ground", Revision::P2040_3, {1e9, 10e9}, {3.0, 0.0, 0.00015, 2.52}},
      {"medium_dry_ground", Revision::P2040_3, {1e9, 10e9}, {15.0, -0.1, 0.035, 1.63}},
      {"wet_ground", Revision::P2040_3, {1e9, 10e9}, {30.0, -0.4, 0.15, 1.3}},
      {"asphalt_concrete", Revision::P2040_4, {1e9, 40e9}, {4.83, 0.0, 0.0108, 1.3969}},
      {"vinyl_tile", Revision::P2040_4, {1e9, 40e9}, {3.62, 0.0, 0.0051, 0.8422}},
      {"carpet_tile", Revision::P2040_4, {1e9, 40e9}, {2.08, 0.0, 0.0009, 0.82}},
      {"concrete_110_ghz", Revision::P2040_4, {110e9, 330e9}, {5.17, 0.0, 0.0145, 1.09}},
      {"brick_110_ghz", Revision::P2040_4, {110e9, 330e9}, {4.15, 0.0, 0.0006, 1.5712}},
  };
  return rows;
}

}  // namespace sigmascape::scatter
