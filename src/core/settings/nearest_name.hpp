// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks {

/// Whether a name may be a misspelt one of another: more than half of the longer one is right, or it is its beginning.
bool mayMean(const std::string& name, const std::string& candidate);

/// The candidate with the smallest edit distance to a misspelt `name` of those that it may mean, the first of equally
/// near ones; empty if there are none.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// What to say of a name that is none of the candidates: "did you mean 'x'?", or which ones there are.
std::string nearestNameHint(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace sks
