// SPDX-License-Identifier: BSD-3-Clause
// The Python module sks_detector._core: what its files share. The GIL is held unless a comment says otherwise.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>

namespace sks::python {

namespace py = pybind11;

// Each adds its classes and functions to the module.
void addErrors(py::module& module);
void addClouds(py::module& module);
void addCodebooks(py::module& module);
void addDetector(py::module& module);
void addTraining(py::module& module);
void addEvaluation(py::module& module);

/// A codebook as Python holds it: immutable, shared with the detectors that were made of it.
struct SharedCodebook {
  std::shared_ptr<const Codebook> codebook;
};

/// A Codebook, or that of the file whose path is given.
std::shared_ptr<const Codebook> codebookOf(const py::object& given);

/// Bytes that need not be UTF-8, such as paths, as Python's str (surrogateescape).
py::str textOf(const std::string& text);

/// Names as a list of str.
py::list namesOf(const std::vector<std::string>& names);

/// The path that a str, bytes or os.PathLike names. @throws py::error_already_set (TypeError) for anything else
std::string pathOf(const py::object& path);

/// Overlays what Python gives as settings: None, the path of a YAML file, or a dict of values by dotted key or of such
/// dicts by group. Old names become warnings. @throws Error(bad_usage), Error(bad_file)
Settings overlaid(Settings settings, const py::object& given);

/// All settings by dotted key.
py::object settingsDict(const Settings& settings);

/// What a JSON text says, as Python's dict and list.
py::object fromJson(const std::string& json);

/// One UserWarning for each text. @throws py::error_already_set where the user made errors of warnings
void warn(const std::vector<std::string>& warnings);

/// From numpy to a cloud: one copy of float32, of float64 two.
/// @param points N x 3, or rows x columns x 3 for an organised cloud [m]
/// @param colors None, or uint8 of the same shape
/// @param width columns of an organised cloud that is given as N x 3; 0: not organised
/// @param sensor_origin None (the origin), or three numbers [m]
/// @throws Error(bad_usage) naming shape or type
std::shared_ptr<Cloud> cloudOf(const py::object& points, const py::object& colors, std::size_t width,
                               const py::object& sensor_origin);

/// A pose as a 4 x 4 array.
py::array_t<double> matrixOf(const Eigen::Isometry3d& pose);
/// An array of three numbers.
py::array_t<double> arrayOf(const Eigen::Vector3d& vector);

}  // namespace sks::python
