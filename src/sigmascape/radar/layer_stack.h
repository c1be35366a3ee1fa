#pragma once

#include <map>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::radar {

/// One number for every cell of a map. Angles are radians.
struct Layer {
  std::string name;
  std::string unit;         ///< "m", "rad", "m2/m2"; empty for masks and classes
  Array2D<float> values;    ///< [column, row]; NaN where nothing is known
  bool is_classes = false;  ///< numbers that stand for names, of which there is no mean
};

/// Layers over the cells of one map: what lies where in the picture.
struct LayerStack {
  GroundGrid grid;
  std::vector<Layer> layers;
  std::string crs;  ///< as PROJ understands it
  std::map<std::string, std::string> metadata;
};

}  // namespace sigmascape::radar
