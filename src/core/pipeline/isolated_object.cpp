// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/isolated_object.hpp"

#include <algorithm>
#include <tuple>

#include "core/pipeline/stopwatch.hpp"

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

Classification classifyIsolated(const Cloud& cloud, ViewKind kind, const Codebook& codebook, const MatchFunction& match,
                                const Settings& settings, const StrengthFunction& strengths) {
  Classification result;
  Stopwatch total;
  const Orientation orientation = kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
  const SceneDescription scene =
      describeScene(cloud, orientation, codebook, match, settings, result.times, result.counts);

  Stopwatch stage;
  const ObjectStrengths found = strengths(scene);
  result.candidates = rankedCandidates(codebook.objects, found.of_object);
  result.counts.hypotheses = found.hypotheses;
  result.times.voting += stage.lap();
  result.times.total = total.lap();
  return result;
}

}  // namespace sks
