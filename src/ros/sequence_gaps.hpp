// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace sks_detector {

/// Tells by the numbers of messages (header.seq) how many were sent that never came: publishers and subscribers drop
/// without a word what their queues cannot hold. roscpp and rospy number what they send from process to process.
///
/// Each publisher has numbers of its own. Those that stand still or go back, as where a publisher starts anew or a bag
/// is played again, tell nothing, nor do jumps too far for the time since the publisher was first heard. Messages that
/// were held up come all at once, so the time since the last one tells nothing. Where each number is a few after the
/// last, as behind a throttle, the smallest step counts as one message.
class SequenceGaps {
public:
  using Clock = std::chrono::steady_clock;

  /// How many messages were lost between the last one of this publisher and this one.
  std::uint32_t lostBefore(const std::string& publisher, std::uint32_t number, Clock::time_point now);
  /// Forgets all publishers: what comes next was not waited for.
  void clear() { publishers_.clear(); }

private:
  struct Publisher {
    std::uint32_t number;    // the last one
    Clock::time_point when;  // it came
    std::uint32_t step = 0;  // smallest between two messages; 0: none yet
    double sendable = 0;     // most messages that may have been sent since it was first heard and did not come yet
  };

  std::map<std::string, Publisher> publishers_;
};

}  // namespace sks_detector
