// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detector.hpp>
#include <sks_detector/thresholds.hpp>

#include "python/module.hpp"

namespace sks::python {
namespace {

std::unique_ptr<Detector> makeDetector(const py::object& given, const py::object& settings) {
  const std::shared_ptr<const Codebook> codebook = codebookOf(given);
  const Settings wanted = overlaid(codebook->settings, settings);
  warn(thresholdWarnings(wanted.detection, codebook->objects));
  const py::gil_scoped_release others_run;
  return std::make_unique<Detector>(codebook, wanted);
}

std::vector<Detection> detectIn(const Detector& detector, const Cloud& cloud, const Thresholds& thresholds) {
  const py::gil_scoped_release others_run;
  return detector.detect(cloud).above(thresholds);
}

py::list detect(const Detector& detector, const py::object& points, const py::object& colors, std::size_t width,
                const py::object& sensor_origin, const py::object& threshold) {
  const std::shared_ptr<Cloud> cloud = cloudOf(points, colors, width, sensor_origin);
  const Thresholds thresholds = threshold.is_none() ? Thresholds(detector.settings().detection)
                                                    : Thresholds(py::float_(threshold).cast<double>());
  py::list list;
  for (Detection& found : detectIn(detector, *cloud, thresholds)) {
    list.append(py::cast(std::move(found)));
  }
  return list;
}

py::str detectionRepr(const Detection& d) {
  const Eigen::Vector3d position = d.position();
  return py::str("<Detection {} score {:.3f} at ({:.3f}, {:.3f}, {:.3f}) m>")
      .format(textOf(d.object), d.score, position.x(), position.y(), position.z());
}

void addDetection(py::module& module) {
  py::class_<Detection>(module, "Detection", "An object found in a cloud, in the frame of the cloud.")
      .def_property_readonly(
          "object", [](const Detection& d) { return textOf(d.object); }, "name")
      .def_readonly("score", &Detection::score, "in [0, 1], comparable across scenes")
      .def_property_readonly(
          "view", [](const Detection& d) { return textOf(d.view); },
          "name of the model's frame: source of a training cloud or mesh")
      .def_property_readonly(
          "T_scene_model", [](const Detection& d) { return matrixOf(d.T_scene_model); },
          "4 x 4, from the frame of the model to that of the cloud")
      .def_property_readonly(
          "box_center", [](const Detection& d) { return matrixOf(d.T_scene_box); },
          "4 x 4: centre and axes of the box in the frame of the cloud")
      .def_property_readonly(
          "box_size", [](const Detection& d) { return arrayOf(d.box_size); }, "full extents along the box's axes [m]")
      .def_property_readonly(
          "position", [](const Detection& d) { return arrayOf(d.position()); }, "centre of the box [m]")
      .def_readonly("votes", &Detection::votes, "votes at the maximum before RANSAC")
      .def_readonly("inliers", &Detection::inliers, "votes that agree on the pose")
      .def("__repr__", &detectionRepr);
}

}  // namespace

void addDetector(py::module& module) {
  addDetection(module);
  py::class_<Detector>(module, "Detector",
                       "Finds the objects of a codebook in clouds. Several threads may use one at the same time.")
      .def(py::init(&makeDetector), py::arg("codebook"), py::arg("settings") = py::none())
      .def("detect", &detect, py::arg("points"), py::arg("colors") = py::none(), py::arg("width") = 0,
           py::arg("sensor_origin") = py::none(), py::arg("threshold") = py::none(),
           "Detections with at least the threshold (None: detection.threshold and detection.thresholds), best first.")
      .def_property_readonly("objects", [](const Detector& detector) { return namesOf(detector.codebook().objects); })
      .def_property_readonly("settings", [](const Detector& detector) { return settingsDict(detector.settings()); });
}

}  // namespace sks::python
