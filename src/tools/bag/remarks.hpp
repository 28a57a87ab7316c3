// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks::tools {

/// How much a remark matters.
enum class Severity {
  note,     ///< good to know
  warning,  ///< the node works, but not as well as it could or not with every option
  error     ///< the node cannot use it
};

/// Something that is odd about a bag.
struct Remark {
  Severity severity = Severity::note;
  std::string topic;    ///< or the frame, or whatever it is about
  std::string message;  ///< what is odd and what to do
};

using Remarks = std::vector<Remark>;

/// "note", "warning" or "error".
std::string severityName(Severity severity);

/// "3 of 20 clouds".
std::string shareText(std::size_t part, std::size_t all, const std::string& things);

}  // namespace sks::tools
