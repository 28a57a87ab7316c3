// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <OpenNI.h>

namespace sks_detector {

/// OpenNI2 with its drivers loaded, shared by all cameras of the process and unloaded with the last of them.
class OpenNi2Library {
public:
  /// @throws sks::Error(bad_data) with OpenNI2's reason, e.g. that it has no drivers
  static std::shared_ptr<OpenNi2Library> get();
  ~OpenNi2Library();
  OpenNi2Library(const OpenNi2Library&) = delete;
  OpenNi2Library& operator=(const OpenNi2Library&) = delete;

  /// Opens what the parameter `device` names: a URI, "#1" for the first in the list, a serial number, an .oni file;
  /// empty: the first. @throws sks::Error(bad_data) naming what was asked for, the devices there are and a remedy;
  /// bad_file for a file that cannot be played
  void open(const std::string& name, openni::Device& device) const;

private:
  OpenNi2Library() = default;
};

/// Of an open device; empty where it has none.
std::string serialNumber(const openni::Device& device);

/// OpenNI2's own words about the last failure, on one line.
std::string openNi2Error();

}  // namespace sks_detector
