// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <sks_detector/registration.hpp>

#include "core/registration/view_coverage.hpp"
#include "io/dataset.hpp"

namespace sks_detector {

/// What the last captured view of an object adds to those before it.
struct CaptureResult {
  sks::RegisteredObject model;      ///< of all views so far
  sks::ViewCoverage coverage;       ///< of the tied ones
  std::optional<std::size_t> same;  ///< an earlier view that shows the same: its number, from 0
};

/// The models of the captured objects so far, kept so that a new view is compared with the others only. Thread-safe.
class CaptureModels {
public:
  /// @param captured all views, in the order of their capture; those of the object are looked at
  /// @throws sks::Error naming a view that cannot be used
  CaptureResult update(const std::string& object, const sks::DataSet& captured, const sks::Settings& settings);

private:
  struct Known {
    std::string settings;  // as YAML
    sks::ObjectRegistrar registrar;
    std::vector<std::string> views;  // what they are, in the order of the registrar
  };

  std::mutex mutex_;
  std::map<std::string, Known> objects_;
};

}  // namespace sks_detector
