// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <ros/time.h>

#include "tools/bag/remarks.hpp"

namespace sks::tools {

/// Whether the stamps of a topic's messages go on as they should.
class StampCheck {
public:
  void add(const ros::Time& stamp, const ros::Time& recorded);

  const std::vector<ros::Time>& stamps() const { return stamps_; }
  /// Messages a second by the median distance of their stamps [Hz]; 0 where there are fewer than two.
  double rate() const;
  void remark(const std::string& topic, Remarks& remarks) const;

private:
  std::vector<ros::Time> stamps_;
  double greatest_delay_ = 0;  // between stamp and recording [s]
};

}  // namespace sks::tools
