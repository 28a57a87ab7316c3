// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"

namespace sks {

Error::Error(ErrorCode code, const std::string& message) : std::runtime_error(shownMessage(message)), code_(code) {}

}  // namespace sks
