#include <nlohmann/json.hpp>
#include <utility>

#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/iq_formats.h"
#include "sigmascape/product/json_text.h"

namespace sigmascape::product {
namespace {

using Json = nlohmann::ordered_json;

Json global_of(const IqRecord& record) {
  Json global{{"core:datatype", "cf32_le"},
              {"core:version", "1.0.0"},
              {"core:num_channels", record.polarizations.size()},
              {"core:description", record.kind + ": " + record.quantity},
              {"core:recorder", "Sigmascape"},
              {"core:extensions", Json::array({{{"name", "sigmascape"}, {"version", "1.0.0"}, {"optional", true}}})}};
  if (record.fast.name == "slant_range" && record.fast.values.size() > 1) {
    // Samples over slant range follow one another in time by 2 Δr / c; along the track or over Doppler they do not.
    global["core:sample_rate"] = speed_of_light_mps / (2.0 * (record.fast.values[1] - record.fast.values[0]));
  }
  const Json description = Json::parse(iq_description(record));
  for (const auto& [key, value] : description.items()) global["sigmascape:" + key] = value;
  for (const IqAxis& column : record.cuts) global["sigmascape:" + axis_name(column)] = column.values;
  global["sigmascape:fast_first"] = record.fast.values.front();
  global["sigmascape:fast_count"] = record.fast.values.size();
  if (record.fast.values.size() > 1) {
    global["sigmascape:fast_step"] =
        (record.fast.values.back() - record.fast.values.front()) / static_cast<double>(record.fast.values.size() - 1);
  }
  return global;
}

/// One for each place on the slow axis: where its samples begin, and where the platform then was.
Json captures_of(const IqRecord& record) {
  Json captures = Json::array();
  for (std::size_t i = 0; i < record.slow.values.size(); ++i) {
    const std::size_t moment = record.platform.size() == 1 ? 0 : i;
    const radar::Motion& motion = record.platform[moment];
    Json capture{{"core:sample_start", i * record.fast.values.size()},
                 {"core:frequency", record.numbers.at("frequency_hz")},
                 {"sigmascape:" + axis_name(record.slow), record.slow.values[i]},
                 {"sigmascape:position_m", {motion.position.x, motion.position.y, motion.position.z}},
                 {"sigmascape:velocity_mps", {motion.velocity_mps.x, motion.velocity_mps.y, motion.velocity_mps.z}}};
    if (!record.beam_azimuth_rad.empty()) capture["sigmascape:beam_azimuth_rad"] = record.beam_azimuth_rad[moment];
    captures.push_back(std::move(capture));
  }
  return captures;
}

}  // namespace

void write_iq_sigmf(const std::filesystem::path& path, const IqRecord& record) {
  const Json meta{{"global", global_of(record)}, {"captures", captures_of(record)}, {"annotations", Json::array()}};
  const std::string words = json_text(meta, 2);
  const auto bytes = std::as_bytes(record.samples);
  geo::write_together({{geo::companion_of(path, ".sigmf-data"),
                        std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())},
                       {path, words}});
}

}  // namespace sigmascape::product
