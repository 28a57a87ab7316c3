// SPDX-License-Identifier: BSD-3-Clause
#include "tools/table.hpp"

#include <algorithm>
#include <cmath>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"

namespace sks::tools {
namespace {

/// Characters, not bytes: continuation bytes of UTF-8 have no width.
std::size_t textWidth(const std::string& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string fixed(double value, int decimals) {
  return std::isnan(value) ? "-" : formatted("%.*f", decimals, value);
}

Table::Table(std::vector<std::string> header) {
  for (std::string& title : header) {
    left_.push_back(!title.empty() && title[0] == '<');
    if (left_.back()) title.erase(0, 1);
  }
  rows_.push_back(std::move(header));
}

void Table::add(std::vector<std::string> row) {
  for (std::string& cell : row) cell = shownMessage(cell);
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::vector<std::size_t> widths(left_.size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], textWidth(row[i]));
  }
  std::string result;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - textWidth(row[i]), ' ');
      line += (i > 0 ? "  " : "") + (left_[i] ? row[i] + gap : gap + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  }
  return result;
}

}  // namespace sks::tools
