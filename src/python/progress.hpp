// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

#include <sks_detector/progress.hpp>

#include "python/module.hpp"

namespace sks::python {

/// Hands progress on to a Python callable, and ends the work where that returns False or raises, or on Ctrl-C. What was
/// raised is kept until the core is left: no Python exception passes through code that does not hold the GIL.
class PythonProgress {
public:
  /// @param callable (stage, item, done, total), or None: then only Ctrl-C is looked for
  explicit PythonProgress(py::object callable) : callable_(std::move(callable)) {}

  /// Runs work(progress) without the GIL, held again by the callable. The work must call it from this thread.
  /// @return what the work returns @throws what the callable raised, KeyboardInterrupt, or what the work throws
  template <typename Work>
  auto run(Work work) {
    try {
      const py::gil_scoped_release others_run;
      return work(Progress([this](const ProgressState& state) { return proceed(state); }));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled && raised_) std::rethrow_exception(raised_);
      throw;
    }
  }

private:
  bool proceed(const ProgressState& state);

  py::object callable_;
  std::exception_ptr raised_;
};

}  // namespace sks::python
