// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/value_text.hpp"

#include <charconv>
#include <locale>
#include <sstream>

namespace sks {

std::string toText(double value) {
  std::string text;
  for (int digits = 10; digits <= 17; ++digits) {  // trailing zeros are not printed, so 10 digits can be "0.1"
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << value;
    text = out.str();
    double back = 0;
    if (fromText(text, back) && back == value) break;
  }
  return text;
}

std::string toText(int value) {
  return std::to_string(value);
}

std::string toText(bool value) {
  return value ? "true" : "false";
}

std::string toText(const std::string& value) {
  return value;
}

bool fromText(const std::string& text, double& value) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  return bool(in >> std::noskipws >> value) && in.peek() == std::istringstream::traits_type::eof();
}

bool fromText(const std::string& text, int& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

bool fromText(const std::string& text, bool& value) {
  value = text == "true";
  return value || text == "false";
}

bool fromText(const std::string& text, std::string& value) {
  value = text;
  return true;
}

std::string allowedValues(const SettingInfo& info) {
  if (info.type == "bool") return "true, false";
  if (info.type == "string") return "any text";
  if (info.type != "choice") {
    return toText(info.range.min) + " to " + toText(info.range.max) + (info.unit.empty() ? "" : " [" + info.unit + "]");
  }
  std::string list;
  for (const std::string& choice : info.choices) list += (list.empty() ? "" : ", ") + choice;
  return list;
}

}  // namespace sks
