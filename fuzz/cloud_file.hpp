// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include <sks_detector/cloud_io.hpp>

#include "core/surface/sanitize.hpp"
#include "memory_file.hpp"
#include "refused.hpp"

namespace sks::fuzz {

inline void requireSound(const Cloud& cloud) {
  require(cloud.size() == std::size_t(cloud.width) * cloud.height, "a cloud has width x height points");
  require(!cloud.hasColor() || cloud.colors.size() == cloud.size(), "a cloud has no colour or one for each point");
}

/// Reads a cloud as every tool and service does, and lets it pass the gate.
inline void readCloudFile(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  refused([&] {
    const Cloud cloud = readCloud(file.path());
    requireSound(cloud);
    requireSound(sanitize(cloud, {}));
  });
}

}  // namespace sks::fuzz
