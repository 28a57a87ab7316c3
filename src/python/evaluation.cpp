// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>

#include "evaluation/evaluation.hpp"
#include "evaluation/registered_truth.hpp"
#include "python/progress.hpp"
#include "python/training.hpp"
#include "tools/evaluation_json.hpp"
#include "tools/object_models.hpp"

namespace sks::python {
namespace {

/// What `sks evaluate --json` writes. Called without the GIL.
/// @param codebook null: it is trained
std::string evaluationText(const DataSet& set, std::shared_ptr<const Codebook> codebook, Settings settings,
                           const Progress& progress, Remarks& remarks) {
  if (!codebook) {
    codebook =
        trainOn(trainingSamples(set, meshViews(default_mesh_views, remarks)), settings, set.name, progress, remarks);
  }
  if (settings.descriptor.type == DescriptorType::automatic) settings.descriptor.type = codebook->descriptor_type;
  for (const std::string& object : untrainedObjects(set, codebook->objects)) {
    remarks.add("object '" + object + "' of the ground truth was never trained: it counts as missed");
  }
  const Detector detector(codebook, settings);
  const DetectFunction detect = [&](const Cloud& cloud) { return detector.detect(cloud); };
  Evaluation evaluation = evaluate(registeredTruth(set, *codebook), detect, "sks", settings, progress);
  scoreAsBop(evaluation, set, tools::objectModels(set), threadCount(settings), progress);
  return tools::evaluationJson(evaluation, codebook->objects)
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

py::object evaluateSet(const py::object& dataset, const py::object& codebook, const py::object& settings,
                       const py::object& progress) {
  const std::shared_ptr<const Codebook> given = codebook.is_none() ? nullptr : codebookOf(codebook);
  const Settings wanted = overlaid(given ? given->settings : Settings(), settings);
  const DataSet set = loadDataSet(pathOf(dataset));
  if (!given && set.training.empty()) {
    throw Error(ErrorCode::bad_usage, "'" + set.file + "' has no training clouds; give a codebook");
  }
  Remarks remarks;
  for (const std::string& warning : set.warnings) remarks.add(warning);
  const std::string json = PythonProgress(progress).run(
      [&](const Progress& report) { return evaluationText(set, given, wanted, report, remarks); });
  warn(remarks.take());
  return fromJson(json);
}

}  // namespace

void addEvaluation(py::module& module) {
  module.def("evaluate", &evaluateSet, py::arg("dataset"), py::arg("codebook") = py::none(),
             py::arg("settings") = py::none(), py::arg("progress") = py::none(),
             "Detects in every scene of a data set file and scores what was found: a dict with the keys of `sks "
             "evaluate --json`. Without a codebook, one is trained on the data set.");
}

}  // namespace sks::python
