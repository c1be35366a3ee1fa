#ifndef SIGMASCAPE_C_INTERFACE_SIGMASCAPE_H
#define SIGMASCAPE_C_INTERFACE_SIGMASCAPE_H

/* The live renderer for programs written in C, or in anything that calls C: open the ground, make a renderer, hand it
 * poses and targets, read frames. Angles are radians, azimuth clockwise from the frame's north, which is true at its
 * origin (docs/live.md); positions are metres of the atlas' local frame (x east, y north, z above mean sea level). No
 * exception crosses this interface: what fails returns null or a number other than 0, and sigmascape_last_error says
 * why.
 *
 * The ground may be shared by any number of renderers on any threads at once; a renderer is for one caller at a time.
 * A child that was forked off has the threads of neither: open and make there what is used there.
 * Poses and targets are best begun with zeros, `= {0}`, settings and tracing with sigmascape_default_settings() and
 * sigmascape_default_tracing(), so that what a later version adds has its default. Structures grow with the minor
 * version alone, which the shared library's name bears: a program that was linked to one loads no other. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Why the last call on this thread failed, in one sentence; empty when none has. Valid until the next failure. */
const char* sigmascape_last_error(void);

/* Baked reflectivity with its terrain, which may be far larger than memory. */
typedef struct sigmascape_ground sigmascape_ground;

/* Opens the folder that `sigmascape bake` wrote, for one frequency; radars of several open it several times.
 * `cache_bytes` bounds the memory of pages, obstacles and terrain together; 0: 512 MiB. Renderers that look at
 * different ground need it for each. Null when it cannot be opened, was not baked near the frequency, or when the bytes
 * hold too little beside the coarsest ground. */
sigmascape_ground* sigmascape_open_ground(const char* atlas_folder, double frequency_hz, size_t cache_bytes);
/* Renderers that still use the ground keep it. Null is allowed. */
void sigmascape_close_ground(sigmascape_ground* ground);

/* Where a place on the globe, WGS 84 in degrees, lies in the atlas' local frame: what poses and targets are given in.
 * The height above mean sea level passes through. Returns 0 when all went well, and otherwise leaves `position_m`: for
 * a place that is nowhere on the globe or too far away for the frame. Looks up what PROJ knows each time: for what has
 * to be placed once. */
int sigmascape_place_in_frame(const sigmascape_ground* ground, double latitude_deg, double longitude_deg,
                              double height_m, double position_m[3]);
/* The other way round. What is null is not told. */
int sigmascape_place_on_globe(const sigmascape_ground* ground, const double position_m[3], double* latitude_deg,
                              double* longitude_deg, double* height_m);

/* Metres of the local frame. */
typedef struct sigmascape_rectangle {
  double west_m, south_m, east_m, north_m;
} sigmascape_rectangle;

/* What the atlas covers. Its terrain may reach farther. Returns 0 when all went well. */
int sigmascape_extent(const sigmascape_ground* ground, sigmascape_rectangle* extent);
/* Height of the ground above mean sea level, of the finest terrain; reads a tile if need be. Returns 0 when all went
 * well, and otherwise leaves `height_m`: for a place beyond the terrain. */
int sigmascape_ground_height(const sigmascape_ground* ground, double x_m, double y_m, double* height_m);

/* What of the ground is in memory, and what could not be had. */
typedef struct sigmascape_ground_report {
  size_t pages, page_bytes; /* of reflectivity, there now */
  uint64_t loaded, evicted; /* pages, since the ground was opened; evicted that goes on rising while the view
                               stays: the memory is less than what renderers look at */
  uint64_t renewed;         /* made anew when some of what they had lacked could be had */
  uint64_t refused;         /* times that no page could give way, so that the memory is less than one frame
                               looks at, or the system had none */
  size_t absent, damaged;   /* pages that could not be had when last asked for; textures that are not as their
                               items say */
  size_t obstacle_bytes, damaged_obstacles; /* of what stands on the ground, where the atlas keeps it apart */
  size_t terrain_bytes, terrain_faults;     /* tiles of terrain, and those that could not be had */
} sigmascape_ground_report;

/* Returns 0 when all went well. */
int sigmascape_report(const sigmascape_ground* ground, sigmascape_ground_report* report);

/* Returns when all pages and all terrain that frames have asked for are there, or cannot be had. For whoever would
 * rather wait than see less; renderers on other threads that go on asking make it longer. Returns 0 when all went
 * well. */
int sigmascape_wait_for_pages(sigmascape_ground* ground);

enum sigmascape_content {
  SIGMASCAPE_AMPLITUDES = 0, /* I/Q with speckle */
  SIGMASCAPE_POWERS = 1      /* mean power */
};

typedef struct sigmascape_settings {
  enum sigmascape_content content;
  size_t beams, ranges; /* bins */
  double beam_step_rad; /* azimuth from bin to bin: an eighth of a turn at most, all beams together a turn */
  double range_step_m;  /* slant range from bin to bin: all together 1e7 m at most */
  double cells_per_bin; /* lattice cells along the smaller side of a bin on the ground */
  uint64_t seed;        /* names the scatterers */
  unsigned threads;     /* 0: one a hardware thread; has no effect on the result */
  double refraction;    /* k of the k-Earth, usually 4/3; 0.1 at least */
} sigmascape_settings;

/* What the C++ interface takes when nothing is said. */
sigmascape_settings sigmascape_default_settings(void);

typedef struct sigmascape_pose {
  double position_m[3];
  double first_azimuth_rad; /* left edge of beam 0 */
  double first_range_m;     /* near edge of range bin 0 */
  double velocity_mps[3];   /* says which ground to fetch ahead of time */
  double time_s;            /* where movers are on their tracks */
  uint64_t dwell, pulse;    /* fluctuation of cases 1 and 3 goes by dwells, that of 2 and 4 by pulses within them */
} sigmascape_pose;

typedef struct sigmascape_way_point {
  double time_s;
  double position_m[3];
} sigmascape_way_point;

/* A point that answers besides the ground, at every level of detail. */
typedef struct sigmascape_target {
  double position_m[3]; /* of its phase centre at time 0 */
  double velocity_mps[3];
  const sigmascape_way_point* way_points; /* instead of both: times increase; null: none */
  size_t way_point_count;
  float rcs_m2[4];       /* VV, HH, HV, Re VV HH*, which is no larger than sqrt(VV HH) */
  const char* rcs_table; /* instead of rcs_m2: a file of cross-sections by aspect (docs/target_file.md); null: none */
  double heading_rad;    /* of the table's nose while the target stands, clockwise from the frame's north */
  int swerling;          /* 0 steady, 1 to 4 fluctuating */
  uint64_t seed;         /* of its fluctuation; give every target its own */
  double size_m[3];      /* length along its heading, width, height of a box that hides the ground behind it; the phase
                            centre is its middle; zeros: no shadow */
} sigmascape_target;

typedef struct sigmascape_frame {
  size_t beams, ranges;
  const float* amplitudes_m; /* [beam][range][VV, HH, HV, VH][real, imaginary]; |a|^2 is a cross-section in m^2, the
                                phase that of the way out and back, -4 pi r/lambda. A point is shared by
                                the bins about it: the sum of their |a|^2 is its cross-section, and the
                                brightest has up to 6 dB less */
  const float* powers_m2;    /* [beam][range][VV, HH, HV, Re VV HH*]; one of the two is null */
  size_t cells, lit;         /* lattice cells looked at, and seen by the radar */
  size_t coarse, dark;       /* cells shown more coarsely than wanted, for pages were not there yet, and not at all:
                                outside the atlas, or where its two coarsest levels cannot be read */
  size_t level;              /* of the textures, 0 the finest */
  double terrain_error_m;    /* by how much the terrain that hides may be wrong, for finer tiles were not there */
  size_t coarse_obstacles;   /* tiles of what stands on the ground, coarser than the bins ask for */
  size_t targets;            /* that stand in the bins and are seen, by a step's beams of a scan */
  uint64_t rays_per_cell;    /* of a traced frame: that it is made of; 0 of one from textures */
  double median_error_db;    /* of a traced frame: standard error of a bin's mean power, in the median over the bins;
                                infinite while too few rays tell */
  double below_ground_m;     /* by how much the radar lies below the ground, as far as the terrain that is there tells
                                for sure; beyond the terrain below the lowest of it, or below mean sea level where that
                                is lower; 0 above it, and of a traced frame */
} sigmascape_frame;

typedef struct sigmascape_renderer sigmascape_renderer;

/* Null when the settings make no sense. */
sigmascape_renderer* sigmascape_make_renderer(sigmascape_ground* ground, const sigmascape_settings* settings);
/* Of a renderer, a tracer or a flight. Null is allowed. */
void sigmascape_free_renderer(sigmascape_renderer* renderer);

/* A landscape, ready for rays. */
typedef struct sigmascape_scene sigmascape_scene;

/* Reads a scene file. Null when it cannot be read. */
sigmascape_scene* sigmascape_open_scene(const char* scene_file);
/* Tracers that still look at the scene keep it. Null is allowed. */
void sigmascape_close_scene(sigmascape_scene* scene);

typedef struct sigmascape_tracing {
  double frequency_hz;
  uint32_t rays_per_cell; /* that each call of sigmascape_render or sigmascape_scan adds to its beams while the pose
                             stays the same */
  int max_bounces;
  double
      lattice_m; /* side of the finest cells of scatterers; that of an atlas' texels gives both the same scatterers */
} sigmascape_tracing;

/* What the C++ interface takes when nothing is said. */
sigmascape_tracing sigmascape_default_tracing(void);

/* A renderer that traces the whole scene into such bins, level of detail 0, for small areas: it takes poses and targets
 * as others do and gives such frames. Null when the settings make no sense. A frame fails for a radar that is less than
 * a metre above the scene's highest point, and for bins that look at more than 2^24 cells of the lattice or too flatly;
 * a flight shows textures then. */
sigmascape_renderer* sigmascape_make_tracer(sigmascape_scene* scene, const sigmascape_settings* settings,
                                            const sigmascape_tracing* tracing);
/* Whether the resolution cell asks for tracing where the tracer's scene is at hand: 0, the level of detail that is
 * traced, when it does, and 1 when textures will do; it knows no atlas, and so none of the coarser levels. Negative
 * when something is wrong. */
int sigmascape_advised_detail(sigmascape_renderer* tracer, const sigmascape_pose* pose);

/* A renderer that traces what has to be traced and takes textures for the rest, as poses ask: one gives way to the
 * other over some frames, each with its share of the power, and no step shows. The atlas is one of that scene;
 * frequency and lattice_m of the tracing have no say. Null when the settings make no sense. */
sigmascape_renderer* sigmascape_make_flight(sigmascape_scene* scene, sigmascape_ground* ground,
                                            const sigmascape_settings* settings, const sigmascape_tracing* tracing);
/* Part of the last frame's power, or of the last step of a scan, that came from textures: 0 where it is traced.
 * Negative when it is no flight. */
double sigmascape_textured_share(const sigmascape_renderer* flight);

/* The targets of all frames from now on, in place of those set before; copied, tables read. The point targets of a
 * tracer's or a flight's scene answer besides. Returns 0 when all went well, and otherwise leaves those before. */
int sigmascape_set_targets(sigmascape_renderer* renderer, const sigmascape_target* targets, size_t count);

/* Renders all beams, or beams first ... first + count - 1 anew and leaves the others: one step of a scanning antenna.
 * A step that goes beyond the last beam ends there; one that begins there, or of no beam, is refused. An antenna turns
 * by the beams of its steps, while first_azimuth_rad stays: beams that are left lie where they were drawn.
 * What is counted in a frame is then counted of those beams. The frame's arrays live until the next call with this
 * renderer. A radar that textures would show from below all ground of the tile of terrain under it is refused, between
 * valid poses too. Returns 0 when all went well, and otherwise leaves `frame`. */
int sigmascape_render(sigmascape_renderer* renderer, const sigmascape_pose* pose, sigmascape_frame* frame);
int sigmascape_scan(sigmascape_renderer* renderer, const sigmascape_pose* pose, size_t first_beam, size_t count,
                    sigmascape_frame* frame);

enum sigmascape_polarization { SIGMASCAPE_VV = 0, SIGMASCAPE_HH = 1, SIGMASCAPE_HV = 2, SIGMASCAPE_VH = 3 };

/* A radar that hears live frames: one for each that frames are heard with, in each polarization. */
typedef struct sigmascape_receiver sigmascape_receiver;

/* Of a radar file (docs/radar_file.md), of whose place and mode nothing is taken but the scan, an azimuth of which is
 * counted from the frame's north as those of poses are, wherever the file places the radar. The ground that bins lie on
 * says from how far below the radar they answer: that of `ground`, or of `scene`, whichever is not null, the former of
 * both. For an antenna that is even in elevation both may be null. `threads`: 0: one a hardware thread; has no
 * effect on the result. Ground and scene are kept. Null when the file cannot be read, or when the antenna tells
 * elevations apart and there is no ground. */
sigmascape_receiver* sigmascape_make_receiver(const char* radar_file, enum sigmascape_polarization polarization,
                                              sigmascape_ground* ground, sigmascape_scene* scene, unsigned threads);
/* The same of the text of such a file, for radars that change in flight. Files that it names lie in `folder`, or where
 * the process is when that is null. */
sigmascape_receiver* sigmascape_make_receiver_of_text(const char* radar_text, const char* folder,
                                                      enum sigmascape_polarization polarization,
                                                      sigmascape_ground* ground, sigmascape_scene* scene,
                                                      unsigned threads);
/* Null is allowed. */
void sigmascape_free_receiver(sigmascape_receiver* receiver);

typedef struct sigmascape_heard {
  size_t beams, ranges;
  const float* signal_w; /* [beam][range], as the bins of frames: mean power at the antenna's terminals of a compressed
                            pulse with the beam's axis in the bin's middle, W; not a number in ranges outside the gate
                            and in azimuths that the scan never comes to */
  double noise_w;        /* mean noise beside it, k T0 B F, the same in every bin */
  size_t first_changed, changed; /* beams that this call made anew, `changed` of them from `first_changed` on; behind
                                    the last beam comes the first one */
  double first_azimuth_rad, beam_step_rad; /* left edge of beam 0, and from beam to beam */
  double first_range_m, range_step_m;      /* near edge of range bin 0, and from bin to bin */
} sigmascape_heard;

/* What a radar hears of the renderer's last frame, targets and all, every beam from where it was drawn. Only beams that
 * were drawn since this receiver heard last are made anew, and some to either side of them; all of another renderer's.
 * Leave first_azimuth_rad and first_range_m while a scan goes on: targets of beams that lie elsewhere now may be lost.
 * The array lives until the next call with this receiver, and the renderer is not to draw meanwhile. Returns 0 when all
 * went well, and otherwise leaves `heard`: for a renderer that has drawn nothing yet or broke off its last frame, and
 * for a radar whose frequency is more than 1 % from that of the frame. */
int sigmascape_hear(sigmascape_receiver* receiver, const sigmascape_renderer* renderer, sigmascape_heard* heard);

#ifdef __cplusplus
}
#endif

#endif
