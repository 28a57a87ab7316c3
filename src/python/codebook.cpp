// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/codebook_file.hpp>

#include "io/codebook_layout.hpp"
#include "python/module.hpp"

namespace sks::python {
namespace {

SharedCodebook load(const py::object& path) {
  const std::string file = pathOf(path);
  const py::gil_scoped_release others_run;
  return {readCodebook(file)};
}

void save(const SharedCodebook& shared, const py::object& path) {
  const std::string file = pathOf(path);
  const py::gil_scoped_release others_run;
  checkCodebookName(file);
  writeCodebook(file, *shared.codebook);
}

py::str codebookRepr(const SharedCodebook& shared) {
  const Codebook& codebook = *shared.codebook;
  return py::str("<Codebook {}: {} objects, {} views, {} codewords of {}>")
      .format(textOf(codebook.name), codebook.objects.size(), codebook.views.size(), codebook.words.size(),
              textOf(codebook.descriptorName()));
}

}  // namespace

std::shared_ptr<const Codebook> codebookOf(const py::object& given) {
  return py::isinstance<SharedCodebook>(given) ? given.cast<const SharedCodebook&>().codebook : load(given).codebook;
}

void addCodebooks(py::module& module) {
  py::class_<SharedCodebook>(module, "Codebook", "What training leaves behind. Immutable; threads may share it.")
      .def_static("load", &load, py::arg("path"), "Reads a codebook file.")
      .def("save", &save, py::arg("path"), "Writes a codebook file (*.sks), whole or not at all.")
      .def_property_readonly("name", [](const SharedCodebook& shared) { return textOf(shared.codebook->name); })
      .def_property_readonly(
          "objects", [](const SharedCodebook& shared) { return namesOf(shared.codebook->objects); },
          "names, in the order of their first training cloud")
      .def_property_readonly(
          "views", [](const SharedCodebook& shared) { return shared.codebook->views.size(); }, "training clouds")
      .def_property_readonly("codewords", [](const SharedCodebook& shared) { return shared.codebook->words.size(); })
      .def_property_readonly(
          "descriptor", [](const SharedCodebook& shared) { return textOf(shared.codebook->descriptorName()); },
          "'shot', 'cshot', or the name of a descriptor of the user")
      .def_property_readonly(
          "settings", [](const SharedCodebook& shared) { return settingsDict(shared.codebook->settings); },
          "what it was trained with, by dotted key")
      .def("__repr__", &codebookRepr);
}

}  // namespace sks::python
