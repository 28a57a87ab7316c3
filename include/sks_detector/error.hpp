// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace sks {

/// What went wrong, so that a front end can choose an exit status or a reply.
enum class ErrorCode {
  bad_usage,     ///< the caller asked for something that does not exist (option, setting, value out of range)
  bad_file,      ///< a file is missing, unreadable, damaged, foreign or newer
  bad_data,      ///< a cloud or data set cannot be used as it is (empty, all NaN, millimetres, no colour)
  incompatible,  ///< codebook and settings (or cloud) do not fit together
  cancelled      ///< the progress callback asked to stop
};

/// The one exception that the core throws. `what()` names the file, key or parameter and the remedy. It is one line of
/// UTF-8 without control characters and of bounded length, whatever text from outside the message quotes.
class Error : public std::runtime_error {
public:
  Error(ErrorCode code, const std::string& message);

  ErrorCode code() const noexcept { return code_; }

private:
  ErrorCode code_;
};

}  // namespace sks
