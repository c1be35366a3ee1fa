#include "sigmascape/c_interface/sigmascape.h"

#include <exception>
#include <memory>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/render/live_renderer.h"

using sigmascape::render::FrameContent;
using sigmascape::render::LiveGround;
using sigmascape::render::LiveRenderer;
using sigmascape::render::LiveSettings;

struct sigmascape_ground {
  std::shared_ptr<LiveGround> ground;
};

struct sigmascape_renderer {
  LiveRenderer renderer;
};

namespace {

thread_local std::string last_error;

/// What `action` returns, or `otherwise` when it throws.
template <typename Result, typename Action>
Result guarded(Result otherwise, Action action) noexcept {
  try {
    return action();
  } catch (const std::exception& failure) {
    try {
      last_error = failure.what();
    } catch (...) {
      last_error.clear();
    }
  }
  return otherwise;
}

template <typename T>
const T& given(const T* pointer, const char* name) {
  if (pointer == nullptr) throw sigmascape::Error(name, "is null", "give what it points to");
  return *pointer;
}

sigmascape::render::Pose pose_from(const sigmascape_pose& pose) {
  return {.position = {pose.position_m[0], pose.position_m[1], pose.position_m[2]},
          .first_azimuth_rad = pose.first_azimuth_rad,
          .first_range_m = pose.first_range_m,
          .velocity_mps = {pose.velocity_mps[0], pose.velocity_mps[1], pose.velocity_mps[2]}};
}

void copy(const sigmascape::render::Frame& from, sigmascape_frame& to) {
  to.beams = from.grid.azimuths;
  to.ranges = from.grid.ranges;
  to.amplitudes_m = from.amplitudes_m.empty() ? nullptr : reinterpret_cast<const float*>(from.amplitudes_m.data());
  to.powers_m2 = from.powers_m2.empty() ? nullptr : from.powers_m2.data();
  to.cells = from.report.cells;
  to.lit = from.report.lit;
  to.coarse = from.report.coarse;
  to.dark = from.report.dark;
}

}  // namespace

const char* sigmascape_last_error(void) {
  return last_error.c_str();
}

sigmascape_ground* sigmascape_open_ground(const char* atlas_folder, double frequency_hz, size_t cache_bytes) {
  return guarded<sigmascape_ground*>(nullptr, [&] {
    sigmascape::render::CacheOptions options;
    if (cache_bytes != 0) options.budget_bytes = cache_bytes;
    (void)given(atlas_folder, "atlas_folder");
    return new sigmascape_ground{LiveGround::open(atlas_folder, frequency_hz, options)};
  });
}

void sigmascape_close_ground(sigmascape_ground* ground) {
  delete ground;
}

void sigmascape_wait_for_pages(sigmascape_ground* ground) {
  if (ground != nullptr) ground->ground->wait_until_loaded();
}

sigmascape_settings sigmascape_default_settings(void) {
  const LiveSettings defaults;
  return {.content = SIGMASCAPE_AMPLITUDES,
          .beams = defaults.beams,
          .ranges = defaults.ranges,
          .beam_step_rad = defaults.beam_step_rad,
          .range_step_m = defaults.range_step_m,
          .cells_per_bin = defaults.cells_per_bin,
          .seed = defaults.seed,
          .threads = defaults.threads,
          .refraction = defaults.refraction};
}

sigmascape_renderer* sigmascape_make_renderer(sigmascape_ground* ground, const sigmascape_settings* settings) {
  return guarded<sigmascape_renderer*>(nullptr, [&] {
    const sigmascape_settings& wanted = given(settings, "settings");
    const LiveSettings live{
        .content = wanted.content == SIGMASCAPE_POWERS ? FrameContent::Powers : FrameContent::Amplitudes,
        .beams = wanted.beams,
        .ranges = wanted.ranges,
        .beam_step_rad = wanted.beam_step_rad,
        .range_step_m = wanted.range_step_m,
        .cells_per_bin = wanted.cells_per_bin,
        .seed = wanted.seed,
        .threads = wanted.threads,
        .refraction = wanted.refraction};
    return new sigmascape_renderer{LiveRenderer(given(ground, "ground").ground, live)};
  });
}

void sigmascape_free_renderer(sigmascape_renderer* renderer) {
  delete renderer;
}

int sigmascape_render(sigmascape_renderer* renderer, const sigmascape_pose* pose, sigmascape_frame* frame) {
  return guarded(1, [&] {
    (void)given(renderer, "renderer");
    (void)given(frame, "frame");
    copy(renderer->renderer.render(pose_from(given(pose, "pose"))), *frame);
    return 0;
  });
}

int sigmascape_scan(sigmascape_renderer* renderer, const sigmascape_pose* pose, size_t first_beam, size_t count,
                    sigmascape_frame* frame) {
  return guarded(1, [&] {
    (void)given(renderer, "renderer");
    (void)given(frame, "frame");
    copy(renderer->renderer.scan(pose_from(given(pose, "pose")), first_beam, count), *frame);
    return 0;
  });
}
