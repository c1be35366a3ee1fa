#pragma once

#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/live/live_renderer.h"

namespace sigmascape {

/// The settings of an example as a program in C would write them; content is left as it is by default.
inline sigmascape_settings said_in_c(const live::LiveSettings& wanted) {
  sigmascape_settings settings = sigmascape_default_settings();
  settings.beams = wanted.beams;
  settings.ranges = wanted.ranges;
  settings.beam_step_rad = wanted.beam_step_rad;
  settings.range_step_m = wanted.range_step_m;
  settings.cells_per_bin = wanted.cells_per_bin;
  settings.seed = wanted.seed;
  settings.refraction = wanted.refraction;
  return settings;
}

inline sigmascape_pose said_in_c(const live::Pose& wanted) {
  sigmascape_pose pose = {};
  pose.position_m[0] = wanted.position.x;
  pose.position_m[1] = wanted.position.y;
  pose.position_m[2] = wanted.position.z;
  pose.first_azimuth_rad = wanted.first_azimuth_rad;
  pose.first_range_m = wanted.first_range_m;
  return pose;
}

}  // namespace sigmascape
