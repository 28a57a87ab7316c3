// SPDX-License-Identifier: BSD-3-Clause
#include "python/progress.hpp"

namespace sks::python {

bool PythonProgress::proceed(const ProgressState& state) {
  const py::gil_scoped_acquire gil;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (callable_.is_none()) return true;
    const py::object answer = callable_(textOf(state.stage), textOf(state.item), state.done, state.total);
    return answer.ptr() != Py_False;
  } catch (const std::exception&) {
    raised_ = std::current_exception();
    return false;
  }
}

}  // namespace sks::python
