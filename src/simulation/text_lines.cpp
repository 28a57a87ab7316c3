// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/text_lines.hpp"

#include <algorithm>

namespace sks {
namespace {

const char* const line_blanks = " \t\v\f";

/// Where a comment begins; names may hold a '#', too.
std::size_t commentIn(const std::string& line) {
  std::size_t at = line.find('#');
  while (at != std::string::npos && at > 0 && line[at - 1] != ' ' && line[at - 1] != '\t') at = line.find('#', at + 1);
  return std::min(at, line.size());
}

}  // namespace

TextLines::TextLines(const std::string& content) : rest_(content) {
  if (content.rfind("\xef\xbb\xbf", 0) == 0) rest_.remove_prefix(3);  // the mark of UTF-8
}

bool TextLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    line_.clear();
    number_ = next_number_;
    for (bool continued = true; continued && !rest_.empty();) {
      const std::size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
      line_.append(rest_.substr(0, length));
      const bool both = rest_.substr(length, 2) == "\r\n";
      rest_.remove_prefix(std::min(rest_.size(), length + (both ? 2 : 1)));
      ++next_number_;
      continued = !line_.empty() && line_.back() == '\\';
      if (continued) line_.back() = ' ';
    }
    const std::string_view line = std::string_view(line_).substr(0, commentIn(line_));
    for (std::size_t at = line.find_first_not_of(line_blanks); at < line.size();) {
      const std::size_t end = std::min(line.find_first_of(line_blanks, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(line_blanks, end);
    }
  }
  return !words_.empty();
}

std::string TextLines::after(std::size_t count) const {
  if (words_.size() <= count) return "";
  const char* const begin = words_[count].data();
  return {begin, words_.back().data() + words_.back().size()};
}

}  // namespace sks
