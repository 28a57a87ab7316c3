// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sks {

/// The lines of OBJ and MTL files: ended by a line feed, a carriage return or both; a backslash at the end continues a
/// line; comments, from a '#' at the begin of a word on, are left out.
class TextLines {
public:
  explicit TextLines(const std::string& content);

  /// Goes to the next line that is not empty; false at the end.
  bool next();
  /// Counted from 1; where a line is continued, the first one.
  std::size_t number() const { return number_; }
  /// Words between blanks and tabs; the first one is the keyword. Valid until the next line.
  const std::vector<std::string_view>& words() const { return words_; }
  /// What follows the first `count` words, without blanks around it.
  std::string after(std::size_t count) const;

private:
  std::string_view rest_;
  std::string line_;
  std::vector<std::string_view> words_;
  std::size_t number_ = 0, next_number_ = 1;
};

}  // namespace sks
