// SPDX-License-Identifier: BSD-3-Clause
#include "python/module.hpp"

#include <sks_detector/error.hpp>

namespace sks::python {
namespace {

PyObject* error_class = nullptr;  // lives as long as the interpreter

const char* nameOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_usage:
      return "bad_usage";
    case ErrorCode::bad_file:
      return "bad_file";
    case ErrorCode::bad_data:
      return "bad_data";
    case ErrorCode::incompatible:
      return "incompatible";
    case ErrorCode::cancelled:
      return "cancelled";
  }
  return "unknown";
}

void raise(const Error& error) {
  py::object instance = py::reinterpret_borrow<py::object>(error_class)(textOf(error.what()));
  instance.attr("code") = nameOf(error.code());
  PyErr_SetObject(error_class, instance.ptr());
}

}  // namespace

void addErrors(py::module& module) {
  error_class = PyErr_NewExceptionWithDoc(
      "sks_detector.Error",
      "What went wrong and what to do. `code` is bad_usage, bad_file, bad_data, incompatible or cancelled.",
      PyExc_RuntimeError, nullptr);
  if (error_class == nullptr) throw py::error_already_set();
  module.add_object("Error", error_class);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace sks::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of sks_detector; import sks_detector instead.";
  sks::python::addErrors(module);
  sks::python::addClouds(module);
  sks::python::addCodebooks(module);
  sks::python::addDetector(module);
  sks::python::addTraining(module);
  sks::python::addEvaluation(module);
}
