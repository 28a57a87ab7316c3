// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks::tools {

/// `value` with a fixed number of decimals; "-" for NaN.
std::string fixed(double value, int decimals);

/// Rows of text in aligned columns.
class Table {
public:
  /// @param header a title that begins with '<' makes its column flush left, others are flush right
  explicit Table(std::vector<std::string> header);

  void add(std::vector<std::string> row);

  /// Columns two spaces apart, the header first; ends with a newline.
  std::string text() const;

private:
  std::vector<bool> left_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace sks::tools
