// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/name_text.hpp"

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "core/settings/utf8.hpp"

namespace sks {

std::string nameFault(const std::string& name) {
  if (name.empty()) return "it is empty; give a name";
  if (name.size() > longest_name) {
    return "it has " + std::to_string(name.size()) + " bytes; use at most " + std::to_string(longest_name);
  }
  if (hasControl(name)) return "it contains a control character; leave that out";
  if (!isUtf8(name)) return "it is not UTF-8; use letters of that encoding";
  return "";
}

void checkName(const std::string& name, const std::string& what) {
  const std::string fault = nameFault(name);
  if (!fault.empty()) throw Error(ErrorCode::bad_usage, what + " '" + shown(name, 60) + "' is refused: " + fault);
}

}  // namespace sks
