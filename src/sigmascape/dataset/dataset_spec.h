#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/simulate/layers.h"

namespace sigmascape::dataset {

/// Numbers are drawn evenly between the two ends.
struct Range {
  double lowest = 0.0, highest = 0.0;
};

/// Point targets of one class.
struct TargetClass {
  std::string name;
  Range number;  ///< of targets a sample; whole numbers, both ends are drawn
  Range rcs_db;  ///< over a square metre, in every polarization but HV, which has none
  double size_m = 0.0;
  double height_m = 0.0;                   ///< of the phase centre above the ground
  Range speed_mps = {}, heading_rad = {};  ///< how it drives, on an even course
  std::optional<Range> east_m = {},
                       north_m = {};  ///< from the middle of the map, at the beginning; without, all over it
};

/// Samples that follow one another in time: the radar flies on and targets drive on.
struct Sequence {
  std::size_t frames = 1;
  double interval_s = 1.0;
  Range speed_mps = {}, course_rad = {};  ///< of the radar, which keeps its altitude
};

/// What of the radar is drawn anew for every sample; the rest stands in the radar's file.
struct RadarRanges {
  std::optional<Range> frequency_hz = {}, range_resolution_m = {}, beam_width_rad = {};
};

enum class Arrangement {
  Folders,     ///< a folder for each sample
  WebDataset,  ///< tar files of many samples
};

/// A dataset as its file describes it; docs/datasets.md lists the keys.
struct DatasetSpec {
  std::filesystem::path file;  ///< where it was read from, for messages
  std::filesystem::path scene;
  std::optional<std::filesystem::path> atlas;  ///< without one, samples are traced at level of detail 0
  radar::RadarFile radar;
  std::size_t count = 0;
  std::uint64_t seed = 1;
  int level_of_detail = 1;
  std::uint32_t samples_per_cell = 16;  ///< rays, at level of detail 0
  std::size_t cells = 256;              ///< along a side of each map
  double cell_m = 2.0;
  std::vector<radar::Polarization> polarizations;
  bool is_half = false;      ///< 16-bit floats instead of 32
  bool in_decibels = false;  ///< instead of linear power
  bool with_preview = true;
  std::vector<simulate::LayerKind> layers;
  std::vector<std::string> bounce_layers;  ///< those that tell bounces apart, see bounce_labels.h
  /// What these need from level of detail 1 on: atlases of the same looks, the first baked with one bounce alone, the
  /// second with two at most, and so on.
  std::vector<std::filesystem::path> bounce_atlases;
  std::string bounce_atlases_key;  ///< under which the file names them
  Arrangement arrangement = Arrangement::Folders;
  std::size_t samples_per_shard = 50;

  Range azimuth_rad, elevation_rad, slant_range_m;
  std::optional<Range> target_east_m, target_north_m;  ///< of the map's middle; without, wherever the map fits

  std::size_t looks = 1;                 ///< of speckle; 0 keeps the mean
  std::optional<Range> snr_db;           ///< of the map's mean power in VV over the noise
  std::optional<Range> noise_sigma0_db;  ///< the noise itself as σ0, instead
  RadarRanges radar_ranges;
  Sequence sequence;
  std::vector<TargetClass> targets;

  std::string text;        ///< the file's own text
  std::string radar_hash;  ///< SHA-256 of the radar file with its tables; two datasets are told apart by both
};

/// Reads and checks a dataset file. Throws Error, naming file and key, for what is missing, unknown, given twice, out
/// of range or impossible by itself: a range that ends before it begins, a radar file with what only other modes have.
[[nodiscard]] DatasetSpec read_dataset_spec(const std::filesystem::path& path);

}  // namespace sigmascape::dataset
