/* Renders one frame of an atlas and prints its mean power: what a program in C does for live frames from textures.
 * Scans, and scenes with their tracers and flights, are in the header.
 *
 *   live ATLAS EAST NORTH     the atlas that `sigmascape bake` wrote, and the place to look at, metres of its frame */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sigmascape/c_interface/sigmascape.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: %s ATLAS EAST NORTH\n", argv[0]);
    return 2;
  }
  sigmascape_ground* ground = sigmascape_open_ground(argv[1], 10e9, 0);
  if (ground == NULL) {
    fprintf(stderr, "%s\n", sigmascape_last_error());
    return 1;
  }

  sigmascape_settings settings = sigmascape_default_settings();
  settings.beams = 64;
  settings.ranges = 64;
  settings.range_step_m = 4.0;
  settings.beam_step_rad = 4.0 / 5000.0;
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground, &settings);
  if (renderer == NULL) {
    fprintf(stderr, "%s\n", sigmascape_last_error());
    return 1;
  }

  /* The radar is 5 km south of the place, a quarter of that above it, and looks north. The Earth curves down to the place,
   * by 1.5 m here and by 590 m from 100 km: over a flat one the bins would lie beside it. */
  const double east = atof(argv[2]), north = atof(argv[3]), away = 5000.0, height = 1250.0;
  double ground_m = 0.0;
  if (sigmascape_ground_height(ground, east, north, &ground_m) != 0) {
    fprintf(stderr, "%s\n", sigmascape_last_error());
    return 1;
  }
  const double below = height + away * away / (2.0 * settings.refraction * 6371008.8);
  sigmascape_pose pose = {.position_m = {east, north - away, ground_m + height}};
  pose.first_azimuth_rad = -0.5 * (double)settings.beams * settings.beam_step_rad;
  pose.first_range_m = sqrt(away * away + below * below) - 0.5 * (double)settings.ranges * settings.range_step_m;

  /* A reflector of 1000 m2 on the place, a hundred metres up. */
  sigmascape_target reflector = {.position_m = {east, north, ground_m + 100.0}, .rcs_m2 = {1000.0F, 1000.0F, 0.0F, 1000.0F}};
  if (sigmascape_set_targets(renderer, &reflector, 1) != 0) {
    fprintf(stderr, "%s\n", sigmascape_last_error());
    return 1;
  }

  sigmascape_frame frame;
  int failed = sigmascape_render(renderer, &pose, &frame);
  /* A simulator would go on with what is there and have the rest a frame later. */
  sigmascape_wait_for_pages(ground);
  failed = failed || sigmascape_render(renderer, &pose, &frame);
  if (failed) {
    fprintf(stderr, "%s\n", sigmascape_last_error());
    return 1;
  }

  double power = 0.0;
  for (size_t bin = 0; bin < frame.beams * frame.ranges; ++bin) {
    const float* vv = frame.amplitudes_m + bin * 8;
    power += (double)vv[0] * vv[0] + (double)vv[1] * vv[1];
  }
  printf("%zu cells, %zu lit, %zu targets seen, terrain good to %.3g m, mean cross-section of a bin in VV %.3g m2\n",
         frame.cells, frame.lit, frame.targets, frame.terrain_error_m, power / (double)(frame.beams * frame.ranges));

  sigmascape_free_renderer(renderer);
  sigmascape_close_ground(ground);
  return 0;
}
