#include <pybind11/stl/filesystem.h>

#include "long_call.h"
#include "parts.h"
#include "python_progress.h"
#include "python_warnings.h"
#include "whole_number.h"

#include "sigmascape/bake/shard.h"
#include "sigmascape/dataset/dataset_run.h"
#include "sigmascape/dataset/dataset_warnings.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using dataset::DatasetReport;

DatasetReport made_dataset(const std::filesystem::path& spec, const std::filesystem::path& folder,
                           const std::string& shard, Threads threads, const py::object& progress) {
  PythonProgress listener(progress);
  return long_call([&] {
    const bake::Shard share = bake::shard_from(shard);
    const dataset::SampleMaker maker(dataset::read_dataset_spec(spec));
    const scene::Scene& scene = maker.scene();
    warn_of(scene);
    warn_of(maker.spec().radar.radar, dataset::dataset_warnings(maker.spec(), scene.terrain, scene.extent));
    return dataset::make_dataset(maker, folder, {share.index, share.count, threads}, listener);
  });
}

}  // namespace

void add_dataset(py::module_& module) {
  py::class_<DatasetReport>(module, "DatasetReport", "What make_dataset() did.")
      .def_readonly("samples", &DatasetReport::samples, "Of the share.")
      .def_readonly("already", &DatasetReport::already, "Of them those that were there before.")
      .def_readonly("is_complete", &DatasetReport::is_complete,
                    "Whether the folder now holds all samples of all shares, and the files about them all.")
      .def("__repr__", [](const DatasetReport& r) {
        return py::str("<sigmascape.DatasetReport samples={} already={} is_complete={}>")
            .format(r.samples, r.already, r.is_complete);
      });
  module.def(
      "make_dataset", &made_dataset, py::arg("spec"), py::arg("folder"), py::kw_only(), py::arg("shard") = "0/1",
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Makes the labelled samples that the file `spec` asks for (TOML, docs/datasets.md) into `folder`: a\n"
      "DatasetReport. A run that was broken off, by Ctrl-C for one, goes on with the same call; while it is at\n"
      "work, another that wants the same samples there is refused. Warns (UserWarning) of radars that are drawn\n"
      "too fine for the cells, as render() does, and of the scene as Scene.read() does.\n\n"
      "shard: '2/8' makes the third of eight equal shares. threads: 0 for one a processor.\n"
      "progress: as for bake().");
}

}  // namespace sigmascape::python
