// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "core/settings/detector_table.hpp"
#include "core/settings/settings_overlay.hpp"
#include "core/settings/threads.hpp"
#include "python/module.hpp"
#include "tools/settings_json.hpp"

namespace sks::python {
namespace {

/// A value as the table of settings reads it.
std::string valueText(const std::string& key, const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value) || PyNumber_Check(value.ptr()) != 0) return py::str(value).cast<std::string>();
  throw Error(ErrorCode::bad_usage, "setting '" + key + "': expected a number, bool or str, not " +
                                        std::string(py::str(value.attr("__class__").attr("__name__"))));
}

void overlay(const py::dict& given, const std::string& prefix, SettingsOverlay& settings,
             std::vector<std::string>& warnings) {
  for (const auto& item : given) {
    if (!py::isinstance<py::str>(item.first)) {
      throw Error(ErrorCode::bad_usage, "settings: each key must be a str, e.g. 'keypoints.discard', not " +
                                            std::string(py::str(py::repr(item.first))));
    }
    const std::string key = prefix + item.first.cast<std::string>();
    if (py::isinstance<py::dict>(item.second) && prefix.empty()) {
      overlay(py::reinterpret_borrow<py::dict>(item.second), key + ".", settings, warnings);
      continue;
    }
    const std::string warning = settings.set(key, valueText(key, item.second));
    if (!warning.empty()) warnings.push_back(warning);
  }
}

}  // namespace

py::str textOf(const std::string& text) {
  PyObject* decoded = PyUnicode_DecodeUTF8(text.data(), Py_ssize_t(text.size()), "surrogateescape");
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::list namesOf(const std::vector<std::string>& names) {
  py::list list;
  for (const std::string& name : names) list.append(textOf(name));
  return list;
}

std::string pathOf(const py::object& path) {
  return py::module::import("os").attr("fsencode")(path).cast<std::string>();
}

Settings overlaid(Settings settings, const py::object& given) {
  std::vector<std::string> warnings;
  if (py::isinstance<py::dict>(given)) {
    SettingsOverlay table({detectorTable().bind(settings)});
    overlay(py::reinterpret_borrow<py::dict>(given), "", table, warnings);
  } else if (!given.is_none()) {
    loadSettings(pathOf(given), settings, &warnings);
  }
  const std::string capped = tooManyThreads(settings);
  if (!capped.empty()) warnings.push_back(capped);
  warn(warnings);
  validate(settings);
  return settings;
}

py::object settingsDict(const Settings& settings) {
  return fromJson(tools::settingsJson(settings).dump());
}

py::object fromJson(const std::string& json) {
  return py::module::import("json").attr("loads")(textOf(json));
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    py::module::import("warnings").attr("warn")(textOf(warning));
  }
}

}  // namespace sks::python
