// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/isolated_object.hpp"

#include <algorithm>
#include <tuple>

#include "core/pipeline/stage_clock.hpp"

namespace sks {
namespace {

std::vector<Classification::Candidate> rankedCandidates(const std::vector<std::string>& objects,
                                                        const std::vector<double>& strengths) {
  double sum = 0;
  for (const double strength : strengths) sum += strength;
  std::vector<Classification::Candidate> candidates;
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    if (strengths[i] > 0) candidates.push_back({objects[i], strengths[i] / sum});
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(-a.score, std::cref(a.object)) < std::make_tuple(-b.score, std::cref(b.object));
  });
  return candidates;
}

}  // namespace

Classification classifyIsolated(const Cloud& cloud, ViewKind kind, const SceneDescriber& describer,
                                const StrengthFunction& strengths) {
  StageClock clock;
  const auto [scene, counts] = describer.describe(cloud, orientationOf(kind), clock);
  const ObjectStrengths found = clock.book(&StageTimes::voting, strengths(scene));
  Classification result;
  result.candidates = rankedCandidates(describer.codebook->objects, found.of_object);
  result.counts = counts;
  result.counts.hypotheses = found.hypotheses;
  result.times = clock.times();
  return result;
}

}  // namespace sks
