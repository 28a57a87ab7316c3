// SPDX-License-Identifier: BSD-3-Clause
#include "io/header_lines.hpp"

#include <charconv>
#include <sstream>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"

namespace sks {
namespace {

constexpr std::size_t longest_line = 1 << 16;
constexpr std::streamoff longest_header = 1 << 20;

}  // namespace

bool HeaderLines::next(std::vector<std::string>& words) {
  words.clear();
  std::string line;
  char c = 0;
  while (line.size() < longest_line && file_.get(c) && c != '\n' && c != '\r') line += c;
  if (!file_ || line.size() == longest_line || file_.tellg() > longest_header) return false;
  if (c == '\r') endAfterReturn();
  std::istringstream split(line);
  for (std::string word; split >> word;) words.push_back(word);
  return true;
}

void HeaderLines::endAfterReturn() {
  if (lone_returns_) return;
  const auto next = file_.peek();
  file_.clear();  // the file may end here
  if (next == '\n') {
    file_.get();
  } else {
    lone_returns_ = true;
  }
}

std::uint64_t headerNumber(const std::string& text, const std::string& what) {
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    throw Error(ErrorCode::bad_data,
                "its header says " + shown(what) + " '" + shown(text) + "', which is no whole number");
  }
  return value;
}

void checkHolds(std::uint64_t points, double bytes_needed, std::uint64_t bytes_there) {
  if (bytes_needed > 4294967295.0) {
    throw Error(ErrorCode::bad_data, std::to_string(points) + " points are more than can be read (4 GiB)");
  }
  if (bytes_needed > double(bytes_there)) {
    throw Error(ErrorCode::bad_data, "it is truncated or its header is wrong: " + std::to_string(points) +
                                         " points need " + std::to_string(std::uint64_t(bytes_needed)) +
                                         " bytes, but " + std::to_string(bytes_there) + " are there");
  }
}

}  // namespace sks
