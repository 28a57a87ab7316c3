// SPDX-License-Identifier: BSD-3-Clause
#include "python/training.hpp"

#include <sks_detector/error.hpp>
#include <sks_detector/registration.hpp>

#include "core/settings/name_text.hpp"
#include "core/settings/shown_text.hpp"
#include "python/progress.hpp"
#include "simulation/mesh_sampler.hpp"

namespace sks::python {
namespace {

/// A training cloud that Python holds.
struct Sample {
  std::string object, source;
  std::shared_ptr<const Cloud> cloud;
  ViewKind kind = ViewKind::view;
};

Sample makeSample(const std::string& object, const py::object& points, const py::object& colors, std::size_t width,
                  const py::object& sensor_origin, const std::string& source, const std::string& kind) {
  checkName(object, "the object's name");
  if (kind != "view" && kind != "model") {
    throw Error(ErrorCode::bad_usage, "kind '" + shown(kind) + "': expected 'view' (seen from one side) or 'model'");
  }
  return {object, source, cloudOf(points, colors, width, sensor_origin),
          kind == "view" ? ViewKind::view : ViewKind::model};
}

TrainingSample toTraining(const Sample& sample, std::size_t index) {
  TrainingSample training;
  training.object = sample.object;
  training.source = sample.source.empty() ? sample.object + "#" + std::to_string(index) : sample.source;
  training.kind = sample.kind;
  training.load = [cloud = sample.cloud] { return *cloud; };
  return training;
}

std::vector<TrainingSample> toTraining(const py::iterable& samples) {
  std::vector<TrainingSample> training;
  for (const py::handle& item : samples) {
    if (!py::isinstance<Sample>(item)) {
      throw Error(ErrorCode::bad_usage, "samples: each must be a sks_detector.Sample, not " +
                                            std::string(py::str(item.attr("__class__").attr("__name__"))));
    }
    training.push_back(toTraining(item.cast<const Sample&>(), training.size()));
  }
  return training;
}

void addMeshes(const py::dict& meshes, DataSet& set) {
  for (const auto& item : meshes) {
    TrainingEntry entry;
    entry.object = py::str(item.first).cast<std::string>();
    checkName(entry.object, "meshes: the object's name");
    entry.source = entry.path = pathOf(py::reinterpret_borrow<py::object>(item.second));
    entry.mesh = true;
    entry.scale = 0;  // recognised
    set.training.push_back(entry);
  }
}

SharedCodebook trainCodebook(const py::object& data, const py::object& settings, const py::object& progress,
                             const py::object& meshes, int views, const std::string& name) {
  const Settings wanted = overlaid(Settings(), settings);
  Remarks remarks;
  DataSet set;
  set.name = "python";
  std::vector<TrainingSample> samples;
  if (py::isinstance<py::list>(data) || py::isinstance<py::tuple>(data)) {
    samples = toTraining(py::reinterpret_borrow<py::iterable>(data));
  } else if (!data.is_none()) {
    set = loadDataSet(pathOf(data));
    for (const std::string& warning : set.warnings) remarks.add(warning);
  }
  if (!meshes.is_none()) addMeshes(py::dict(meshes), set);
  for (TrainingSample& sample : trainingSamples(set, meshViews(views, remarks))) samples.push_back(std::move(sample));
  if (samples.empty()) {
    throw Error(ErrorCode::bad_usage,
                "there is nothing to train: give a data set file with training clouds, a list of Sample, or meshes");
  }
  const std::string title = name.empty() ? set.name : name;
  checkName(title, "the name of the codebook");
  SharedCodebook trained;
  trained.codebook = PythonProgress(progress).run(
      [&](const Progress& report) { return trainOn(samples, wanted, title, report, remarks); });
  warn(remarks.take());
  return trained;
}

}  // namespace

void Remarks::add(const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  texts_.push_back(text);
}

std::vector<std::string> Remarks::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(texts_);
}

MeshSampler meshViews(int views, Remarks& remarks) {
  MeshTraining training;
  training.views = views;
  training.threads = threadCount(Settings());
  return meshSampler(training, [&remarks](const std::string& text) { remarks.add(text); });
}

std::shared_ptr<const Codebook> trainOn(const std::vector<TrainingSample>& samples, const Settings& settings,
                                        const std::string& name, const Progress& progress, Remarks& remarks) {
  RegisteredTraining trained = trainRegistered(samples, settings, name, progress);
  for (const std::string& text : registrationWarnings(trained.objects)) remarks.add(text);
  for (const std::string& text : trainingWarnings(trained.codebook)) remarks.add(text);
  return std::make_shared<const Codebook>(std::move(trained.codebook));
}

void addTraining(py::module& module) {
  py::class_<Sample>(module, "Sample", "A training cloud. kind: 'view' (seen from one side) or 'model' (from all).")
      .def(py::init(&makeSample), py::arg("object"), py::arg("points"), py::arg("colors") = py::none(),
           py::arg("width") = 0, py::arg("sensor_origin") = py::none(), py::arg("source") = "",
           py::arg("kind") = "view");
  module.def("train", &trainCodebook, py::arg("dataset") = py::none(), py::arg("settings") = py::none(),
             py::arg("progress") = py::none(), py::arg("meshes") = py::none(), py::arg("views") = default_mesh_views,
             py::arg("name") = "",
             "Trains a codebook from a data set file or a list of Sample, and from meshes (a dict: name to file, or to "
             "'builtin:mug' and the like), each seen from so many views. progress(stage, item, done, total) may return "
             "False to cancel.");
}

}  // namespace sks::python
