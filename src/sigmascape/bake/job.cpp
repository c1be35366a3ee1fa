#include "sigmascape/bake/job.h"

namespace sigmascape::bake {

JobList::JobList(const atlas::AtlasDescription& atlas)
    : axes_(atlas.aspects), patches_(atlas.patches.block_over(atlas.extent)) {}

Job JobList::operator[](std::size_t number) const {
  const std::size_t within = number % aspects();
  const std::size_t azimuth = within % axes_.azimuths_rad.size();
  const std::size_t elevation = within / axes_.azimuths_rad.size();
  Job job{patches_[number / aspects()], axes_.look(axes_.index_of(azimuth, elevation, 0)).aspect, {}};
  for (std::size_t frequency = 0; frequency < axes_.frequencies_hz.size(); ++frequency) {
    job.looks.push_back(axes_.index_of(azimuth, elevation, frequency));
  }
  return job;
}

}  // namespace sigmascape::bake
