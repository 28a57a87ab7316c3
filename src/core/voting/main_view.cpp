// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/main_view.hpp"

#include <algorithm>
#include <map>

namespace sks {

std::uint32_t mainView(const Codebook& codebook, const std::vector<std::uint32_t>& words) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t word : words) ++counts[codebook.words[word].view];
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(counts.begin(), counts.end(), fewer)->first;
}

}  // namespace sks
