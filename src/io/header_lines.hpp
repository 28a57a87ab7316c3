// SPDX-License-Identifier: BSD-3-Clause
// Reading the text headers of cloud files. Every length that a header tells is compared with the length of the file
// before it is used, so that nothing is allocated or read on a file's word. Errors do not name the file: readCloud()
// adds its name.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace sks {

/// Goes through the lines of a header, whether they end with LF, CR or both, also mixed.
class HeaderLines {
public:
  explicit HeaderLines(std::istream& file) : file_(file) {}

  /// Splits the next line at blanks; false at the file's end or where there is too much text for a header.
  bool next(std::vector<std::string>& words);

private:
  void endAfterReturn();

  std::istream& file_;
  bool lone_returns_ = false;  // lines end with CR alone: a byte 10 after the last one belongs to binary data
};

/// A whole number of a header. @throws Error(bad_data) naming `what`
std::uint64_t headerNumber(const std::string& text, const std::string& what);

/// @throws Error(bad_data) if fewer bytes are there than needed: the file is truncated or its header wrong
void checkHolds(std::uint64_t points, double bytes_needed, std::uint64_t bytes_there);

}  // namespace sks
