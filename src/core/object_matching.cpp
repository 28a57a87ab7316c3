// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/object_matching.hpp>

#include <cmath>
#include <limits>

namespace sks {
namespace {

constexpr double steepness = 10;            // of the weights
constexpr double distance_floor = 1e-6;     // so that equal descriptors weigh equally
constexpr float nothing = std::numeric_limits<float>::infinity();

/// The nearest word of each object, and of all.
struct Nearest {
  std::vector<Match> of_object;
  float distance;
  std::uint32_t object;
};

void keepNearly(const Nearest& nearest, double ambiguity, std::vector<Match>& kept) {
  if (nearest.distance == nothing) return;
  for (std::uint32_t object = 0; object < nearest.of_object.size(); ++object) {
    Match match = nearest.of_object[object];
    const bool first = object == nearest.object;
    if (!first && (ambiguity <= 1 || !(match.distance <= ambiguity * nearest.distance))) continue;
    match.weight = float(std::pow((nearest.distance + distance_floor) / (match.distance + distance_floor), steepness));
    kept.push_back(match);
  }
}

}  // namespace

ObjectMatcher::ObjectMatcher(const Codebook& codebook) : objects_(codebook.objects.size()) {
  const auto owner = std::make_shared<const DescriptorMatrix>(codebook.descriptors);
  const auto objectOf = [&](std::size_t word) { return codebook.views[codebook.words[word].view].object; };
  for (std::size_t first = 0; first < codebook.words.size();) {
    std::size_t end = first + 1;
    while (end < codebook.words.size() && objectOf(end) == objectOf(first)) ++end;
    const DescriptorMatrix rows(owner->row(first), end - first, owner->cols(), owner);
    runs_.push_back({objectOf(first), std::uint32_t(first), Matcher(rows)});
    first = end;
  }
}

std::vector<Match> ObjectMatcher::match(const DescriptorMatrix& queries, double ambiguity, int threads) const {
  const Match none{0, 0, nothing};
  std::vector<Nearest> nearest(queries.rows(), Nearest{std::vector<Match>(objects_, none), nothing, 0});
  for (const Run& run : runs_) {
    for (Match match : run.matcher.match(queries, threads)) {
      match.word += run.first_word;
      Nearest& known = nearest[match.descriptor];
      Match& of_object = known.of_object[run.object];
      if (match.distance < of_object.distance) of_object = match;
      if (match.distance < known.distance) {
        known.distance = match.distance;
        known.object = run.object;
      }
    }
  }
  std::vector<Match> kept;
  for (const Nearest& one : nearest) keepNearly(one, ambiguity, kept);
  return kept;
}

}  // namespace sks
