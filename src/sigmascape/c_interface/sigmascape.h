#ifndef SIGMASCAPE_C_INTERFACE_SIGMASCAPE_H
#define SIGMASCAPE_C_INTERFACE_SIGMASCAPE_H

/* The live renderer for programs written in C, or in anything that calls C: open the ground, make a renderer, hand it
 * poses, read frames. Angles are radians, azimuth clockwise from true north; positions are metres of the atlas' local
 * frame (x east, y north, z above mean sea level). No exception crosses this interface: what fails returns null or a
 * number other than 0, and sigmascape_last_error says why. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Why the last call on this thread failed, in one sentence; empty when none has. Valid until the next failure. */
const char* sigmascape_last_error(void);

/* Baked reflectivity with its terrain, shared by any number of renderers. */
typedef struct sigmascape_ground sigmascape_ground;

/* Opens the folder that `sigmascape bake` wrote. `cache_bytes` bounds the memory of all pages together; 0: 512 MiB.
 * Null when it cannot be opened. */
sigmascape_ground* sigmascape_open_ground(const char* atlas_folder, double frequency_hz, size_t cache_bytes);
/* Renderers that still use the ground keep it. Null is allowed. */
void sigmascape_close_ground(sigmascape_ground* ground);
/* Returns when all pages that frames have asked for are there. For whoever would rather wait than see less. */
void sigmascape_wait_for_pages(sigmascape_ground* ground);

enum sigmascape_content {
  SIGMASCAPE_AMPLITUDES = 0, /* I/Q with speckle */
  SIGMASCAPE_POWERS = 1      /* mean power */
};

typedef struct sigmascape_settings {
  enum sigmascape_content content;
  size_t beams, ranges; /* bins */
  double beam_step_rad; /* azimuth from bin to bin */
  double range_step_m;  /* slant range from bin to bin */
  double cells_per_bin; /* lattice cells along the smaller side of a bin on the ground */
  uint64_t seed;        /* names the scatterers */
  unsigned threads;     /* 0: one a hardware thread; has no effect on the result */
  double refraction;    /* k of the k-Earth, usually 4/3 */
} sigmascape_settings;

/* What the C++ interface takes when nothing is said. */
sigmascape_settings sigmascape_default_settings(void);

typedef struct sigmascape_pose {
  double position_m[3];
  double first_azimuth_rad; /* left edge of beam 0 */
  double first_range_m;     /* near edge of range bin 0 */
  double velocity_mps[3];   /* says which ground to fetch ahead of time */
} sigmascape_pose;

typedef struct sigmascape_frame {
  size_t beams, ranges;
  const float* amplitudes_m; /* [beam][range][VV, HH, HV, VH][real, imaginary]; |a|^2 is a cross-section in m^2 */
  const float* powers_m2;    /* [beam][range][VV, HH, HV, Re VV HH*]; one of the two is null */
  size_t cells, lit;         /* lattice cells looked at, and seen by the radar */
  size_t coarse, dark;       /* cells shown more coarsely than wanted, and not at all, for pages were not there yet */
} sigmascape_frame;

typedef struct sigmascape_renderer sigmascape_renderer;

/* Null when the settings make no sense. */
sigmascape_renderer* sigmascape_make_renderer(sigmascape_ground* ground, const sigmascape_settings* settings);
void sigmascape_free_renderer(sigmascape_renderer* renderer);

/* Renders all beams, or beams first ... first + count - 1 anew. The frame's arrays live until the next call with this
 * renderer. Returns 0 when all went well. */
int sigmascape_render(sigmascape_renderer* renderer, const sigmascape_pose* pose, sigmascape_frame* frame);
int sigmascape_scan(sigmascape_renderer* renderer, const sigmascape_pose* pose, size_t first_beam, size_t count,
                    sigmascape_frame* frame);

#ifdef __cplusplus
}
#endif

#endif
