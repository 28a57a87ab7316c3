// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sequence_gaps.hpp"

#include <algorithm>
#include <utility>

namespace sks_detector {
namespace {

constexpr std::size_t most_publishers = 100;  // bags that are played have a new name each time
constexpr double highest_rate = 1000;         // [Hz] that clouds are sent at
constexpr double longest_delay = 60;          // [s] that messages are held up
constexpr double always_plausible = 10;       // messages, whatever the time

}  // namespace

std::uint32_t SequenceGaps::lostBefore(const std::string& publisher, std::uint32_t number, Clock::time_point now) {
  if (publishers_.size() >= most_publishers && publishers_.count(publisher) == 0) publishers_.clear();
  const auto [entry, is_new] = publishers_.try_emplace(publisher, Publisher{number, now});
  if (is_new) return 0;
  Publisher& last = entry->second;
  const auto step = std::int32_t(number - last.number);  // numbers begin again after the largest
  const double seconds = std::chrono::duration<double>(now - last.when).count();
  last.number = number;
  last.when = now;
  last.sendable = std::min(last.sendable + highest_rate * seconds, highest_rate * longest_delay);
  if (step <= 0 || step > always_plausible + last.sendable) {
    last.step = 0;
    last.sendable = 0;
    return 0;
  }
  last.sendable = std::max(last.sendable - step, 0.0);
  const std::uint32_t before =
      std::exchange(last.step, last.step == 0 ? step : std::min<std::uint32_t>(last.step, step));
  return before == 0 ? 0 : std::max<std::uint32_t>(step / before, 1) - 1;
}

}  // namespace sks_detector
