// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace sks_detector {

/// Why no clouds may come on a topic, by what the master knows: "1 publisher"; that it is a topic of images; or that
/// it has no publisher, with the topics of clouds that have one. Where the master is away only the publishers are told.
/// @param publishers that are connected
/// @param own_namespace whose topics are the node's own
std::string describeInput(const std::string& topic, std::uint32_t publishers, const std::string& own_namespace);

}  // namespace sks_detector
