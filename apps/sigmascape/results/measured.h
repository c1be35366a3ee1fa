#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "results/table.h"

namespace sigmascape::cli {

/// A view of a scene, and all that was measured there.
struct MeasuredView {
  std::string scene;  ///< "hills", "level" or "place"
  PlannedView view;
  std::vector<std::string> machines;  ///< that its times are of, each once
  std::vector<ViewResult> results;
};

/// What was measured so far, kept in a file of JSON that is written anew after every view, so that a measurement of
/// hours can be broken off and go on, here or on another machine.
class MeasuredViews {
 public:
  /// Nothing yet; `settings` are all that decides the numbers of a view (settings_of_views).
  MeasuredViews(std::filesystem::path file, nlohmann::ordered_json settings);

  /// From the file itself, where there is one that fits; one that does not is written over.
  void go_on();
  /// Takes over what another run has kept. Throws Error when it cannot be read or was measured with other settings,
  /// naming the first that differs.
  void take_over(const std::filesystem::path& other);
  /// Writes the file, in which what was taken over is kept from then on, once nothing speaks against writing there.
  void write() const;
  /// Writes another file, of some of these views.
  void write(const std::filesystem::path& file, std::span<const MeasuredView* const> views) const;

  /// What was measured of that view with as many rays or more, or nullptr; it stays until a view is added. Of views on
  /// the grid, whose looks are baked again with the rays of their truth, with as many alone.
  [[nodiscard]] const MeasuredView* find(const std::string& scene, const PlannedView& view) const;
  /// Adds a view, in place of the same with fewer rays, or on the grid with as many, and writes the file.
  const MeasuredView& add(MeasuredView view);

 private:
  void read(const std::filesystem::path& file);
  void put(MeasuredView view);

  std::filesystem::path file_;
  nlohmann::ordered_json settings_;
  std::vector<MeasuredView> views_;
};

/// The results of every view that such a file holds, whatever they were measured with; none where there is no such file
/// or one of another form.
[[nodiscard]] std::vector<ViewResult> results_kept_in(const std::filesystem::path& file);

/// What decides the numbers of a view besides the view itself: `scene` is a digest of the scene.
[[nodiscard]] nlohmann::ordered_json settings_of_views(const ResultsPlan& plan, const std::string& scene);

}  // namespace sigmascape::cli
