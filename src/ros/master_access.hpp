// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace sks_detector {

/// Whether the master answers, within a second. To be asked before anything that roscpp registers there while the node
/// runs: it would wait for a master that is gone, and hold locks meanwhile that others need to end. Unlike
/// ros::master::check() it also returns where the master is stopped or out of reach.
bool masterAnswers();

/// The same of any host. @param timeout [s]
bool answersXmlRpc(const std::string& host, std::uint32_t port, double timeout);

/// "the master at http://robot:11311/ does not answer"
std::string masterIsAway();

}  // namespace sks_detector
