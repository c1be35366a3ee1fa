#include "coherent_render.h"

#include <utility>

#include "received_files.h"
#include "stopwatch.h"

#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/simulate/mode_image.h"

namespace sigmascape::cli {

namespace {

void write_slant_image(const CoherentRequest& request, const simulate::ModeRequest& wanted,
                       const simulate::ModePlan& planned) {
  const simulate::ModeImage image = simulate::mode_image(wanted, planned.plan);
  Provenance words = simulate::source_of(wanted, planned);
  words.insert(request.origin.begin(), request.origin.end());
  words["crs"] = request.scene.frame.proj();
  product::IqRecord record =
      std::visit([&](const auto& of) { return product::iq_record(of, request.radar, words); }, image);
  // What the image knows itself, as the interval of its pulses, is nearer to the truth than the plan.
  record.numbers.merge(simulate::numbers_of_one_look(planned.plan));
  product::write_iq(request.slant_file, record);
}

}  // namespace

CoherentMap coherent_map(const CoherentRequest& request) {
  const simulate::ModeRequest wanted{
      .atlas = request.atlas,
      .terrain = request.scene.terrain,
      .radar = request.radar,
      .grid = request.grid,
      .texture_frequency_hz = request.texture_frequency_hz,
      .targets = request.targets,
      .windblown = request.radar.wind_mps > 0.0 ? simulate::windblown_of(request.scene) : simulate::Windblown{},
      .level_of_detail = request.level_of_detail,
      .seed = request.seed,
      .dwell = request.dwell,
      .moment_s = request.moment_s,
      .threads = request.threads};
  const simulate::ModePlan planned = simulate::mode_plan(wanted);
  const radar::CoherentPlan& plan = planned.plan;
  warn_of(request.radar, planned.warnings);
  const Stopwatch watch;
  product::LooksOnGround looks(request.scene.terrain, request.grid, request.threads);
  simulate::mode_looks(wanted, plan, [&](const simulate::ModeImage& look) {
    std::visit([&](const auto& image) { looks.add(image); }, look);
  });
  CoherentMap made{.map = looks.map()};
  made.seconds = watch.seconds();
  made.provenance = simulate::provenance_of(wanted, planned);
  if (!request.slant_file.empty()) write_slant_image(request, wanted, planned);
  made.cost = {{"mode", radar::mode_word(request.radar.mode)},
               {"interval_s", plan.interval_s},
               {"looks", plan.looks},
               {"along_resolution_m", plan.along_resolution_m}};
  return made;
}

}  // namespace sigmascape::cli
