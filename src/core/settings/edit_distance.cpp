// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/edit_distance.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

namespace sks {
namespace {

constexpr std::size_t longest = 100;  // what people misspell is shorter

}  // namespace

std::size_t editDistance(const std::string& whole_a, const std::string& whole_b) {
  const std::string_view a = std::string_view(whole_a).substr(0, longest);
  const std::string_view b = std::string_view(whole_b).substr(0, longest);
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({replaced, last[j] + 1, current[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

}  // namespace sks
