// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "python/module.hpp"

namespace sks::python {
namespace {

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float) && sizeof(Rgb) == 3, "rows of numpy arrays");

constexpr Py_ssize_t axes = 3;  // of a point; channels of a colour

std::string shapeText(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::bad_usage, message);
}

/// The array that an argument is, or can be made into.
py::array toArray(const py::object& given, const std::string& name) {
  const py::array array = py::array::ensure(given);
  if (!array)
    refuse(name + ": expected a numpy array, not " + std::string(py::str(given.attr("__class__").attr("__name__"))));
  return array;
}

void copyPoints(const py::array& points, std::size_t width, Cloud& cloud) {
  if (points.dtype().kind() != 'f') {
    refuse("points: expected float32 or float64 in metres, not " + std::string(py::str(points.dtype())) +
           "; for millimetres give points * 0.001");
  }
  const Py_ssize_t dimensions = points.ndim();
  if ((dimensions != 2 && dimensions != 3) || points.shape(dimensions - 1) != axes) {
    refuse("points: expected an array of shape (N, 3), or (rows, columns, 3) for an organised cloud, not " +
           shapeText(points));
  }
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(points);
  if (!values) throw py::error_already_set();
  cloud.points.resize(std::size_t(values.size() / axes));
  if (!cloud.points.empty()) {
    std::memcpy(cloud.points.data()->data(), values.data(), std::size_t(values.size()) * sizeof(float));
  }
  const std::size_t columns = dimensions == 3 ? std::size_t(points.shape(1)) : width;
  if (width != 0 && width != columns) {
    refuse("width " + std::to_string(width) + ": points of shape " + shapeText(points) + " have " +
           std::to_string(columns) + " columns; leave width out");
  }
  if (columns == 0) return;
  if (cloud.points.size() % columns != 0) {
    refuse("width " + std::to_string(width) + ": " + std::to_string(cloud.points.size()) +
           " points are not whole rows of an organised cloud");
  }
  cloud.width = std::uint32_t(columns);
  cloud.height = std::uint32_t(cloud.points.size() / columns);
}

void copyColors(const py::array& colors, const py::array& points, Cloud& cloud) {
  if (colors.dtype().kind() != 'u' || colors.dtype().itemsize() != 1) {
    refuse("colors: expected uint8 from 0 to 255, not " + std::string(py::str(colors.dtype())));
  }
  if (!colors.attr("shape").equal(points.attr("shape"))) {
    refuse("colors: expected the shape of the points, " + shapeText(points) + ", not " + shapeText(colors));
  }
  const auto values = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(colors);
  if (!values) throw py::error_already_set();
  cloud.colors.resize(cloud.points.size());
  if (!cloud.colors.empty()) std::memcpy(&cloud.colors.data()->r, values.data(), std::size_t(values.size()));
}

/// An array that looks into a cloud and keeps it alive; not writable, as the cloud may be in use.
template <typename Value>
py::array viewOf(const std::shared_ptr<Cloud>& cloud, const Value* values) {
  std::vector<Py_ssize_t> shape{Py_ssize_t(cloud->size()), axes};
  if (cloud->organized()) shape = {Py_ssize_t(cloud->height), Py_ssize_t(cloud->width), axes};
  py::array array(py::dtype::of<Value>(), shape, {}, values, py::cast(cloud));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::object colorsOf(const std::shared_ptr<Cloud>& cloud) {
  if (!cloud->hasColor()) return py::none();
  return viewOf<std::uint8_t>(cloud, &cloud->colors.data()->r);
}

std::shared_ptr<Cloud> readCloudFile(const py::object& path, double scale) {
  const std::string file = pathOf(path);
  if (!(scale > 0)) refuse("scale " + std::to_string(scale) + ": expected a positive number, 0.001 for millimetres");
  const py::gil_scoped_release others_run;
  return std::make_shared<Cloud>(readCloud(file, scale));
}

}  // namespace

std::shared_ptr<Cloud> cloudOf(const py::object& points, const py::object& colors, std::size_t width,
                               const py::object& sensor_origin) {
  if (py::isinstance<Cloud>(points)) {
    if (!colors.is_none() || width != 0 || !sensor_origin.is_none()) {
      refuse("colors, width and sensor_origin are already in the Cloud: leave them out");
    }
    return points.cast<std::shared_ptr<Cloud>>();
  }
  const py::array array = toArray(points, "points");
  auto cloud = std::make_shared<Cloud>();
  copyPoints(array, width, *cloud);
  if (!colors.is_none()) copyColors(toArray(colors, "colors"), array, *cloud);
  if (!sensor_origin.is_none()) {
    const auto origin = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(sensor_origin);
    if (!origin || origin.size() != axes) refuse("sensor_origin: expected three numbers [m]");
    cloud->sensor_origin = Eigen::Map<const Eigen::Vector3f>(origin.data());
  }
  return cloud;
}

py::array_t<double> matrixOf(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose.matrix();
  return py::array_t<double>(std::vector<Py_ssize_t>{4, 4}, matrix.data());
}

py::array_t<double> arrayOf(const Eigen::Vector3d& vector) {
  return py::array_t<double>(std::vector<Py_ssize_t>{axes}, vector.data());
}

void addClouds(py::module& module) {
  py::class_<Cloud, std::shared_ptr<Cloud>>(module, "Cloud",
                                            "A point cloud in metres; it can be given in place of points.")
      .def(py::init(&cloudOf), py::arg("points"), py::arg("colors") = py::none(), py::arg("width") = 0,
           py::arg("sensor_origin") = py::none())
      .def_property_readonly(
          "points",
          [](const std::shared_ptr<Cloud>& cloud) {
            return viewOf<float>(cloud, reinterpret_cast<const float*>(cloud->points.data()));
          },
          "float32, (N, 3), or (rows, columns, 3) if organised [m]; a view, not a copy")
      .def_property_readonly("colors", &colorsOf, "uint8 of the shape of the points, or None; a view, not a copy")
      .def_property_readonly(
          "sensor_origin", [](const Cloud& cloud) { return arrayOf(cloud.sensor_origin.cast<double>()); },
          "position of the camera [m]")
      .def_property_readonly("organized", &Cloud::organized)
      .def("__len__", &Cloud::size);
  module.def("read_cloud", &readCloudFile, py::arg("path"), py::arg("scale") = 1.0,
             "Reads a PCD or PLY file. scale: factor from the file's unit to metres.");
}

}  // namespace sks::python
