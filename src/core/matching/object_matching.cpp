// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/object_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/matching/nearest_word.hpp"

namespace sks {
namespace {

constexpr double steepness = 10;         // of the weights
constexpr double distance_floor = 1e-6;  // so that equal descriptors weigh equally
constexpr float infinite = std::numeric_limits<float>::infinity();

/// @param of_object nearest words of one query, one for each object
/// @param background distance to what is no object
void keepNearly(const Match* of_object, std::size_t objects, double ambiguity, float background,
                std::vector<Match>& kept) {
  const auto nearer = [](const Match& a, const Match& b) {
    return std::make_pair(a.distance, a.word) < std::make_pair(b.distance, b.word);
  };
  const Match nearest = *std::min_element(of_object, of_object + objects, nearer);
  if (nearest.distance == infinite) return;
  const bool object_is_nearest = nearest.distance <= background;
  const float smallest = object_is_nearest ? nearest.distance : background;
  for (std::size_t i = 0; i < objects; ++i) {
    Match match = of_object[i];
    const bool first = object_is_nearest && match.word == nearest.word && match.distance == nearest.distance;
    if (!first && (ambiguity <= 1 || !(match.distance <= ambiguity * smallest))) continue;
    match.weight = float(std::pow((smallest + distance_floor) / (match.distance + distance_floor), steepness));
    kept.push_back(match);
  }
}

}  // namespace

ObjectMatcher::ObjectMatcher(const Codebook& codebook) {
  std::vector<char> has_words(codebook.objects.size(), 0);
  for (const Codeword& word : codebook.words) has_words[codebook.views[word.view].object] = 1;
  std::vector<std::uint32_t> group_of_object(has_words.size(), 0);
  for (std::size_t object = 0; object < has_words.size(); ++object) {  // in their order, as matches are
    if (has_words[object]) group_of_object[object] = std::uint32_t(objects_++);
  }
  std::vector<std::uint32_t> group_of_word;
  for (const Codeword& word : codebook.words) {
    group_of_word.push_back(group_of_object[codebook.views[word.view].object]);
  }
  const bool exact = searchesExactly(SearchKind::automatic, codebook.words.size());
  index_ = std::make_shared<NearestWord>(codebook.descriptors, exact ? SearchEffort::exact() : SearchEffort::quick(),
                                         group_of_word, objects_);
}

std::vector<Match> ObjectMatcher::match(const DescriptorMatrix& queries, double ambiguity, int threads,
                                        const NearestWord* background) const {
  if (index_->words().rows() == 0 || queries.rows() == 0) return {};
  const std::vector<Match> nearest = index_->find(queries, float(ambiguity), threads);
  std::vector<float> limits;  // farther background words do not matter
  for (std::size_t i = 0; i < nearest.size(); i += objects_) {
    const auto nearer = [](const Match& a, const Match& b) { return a.distance < b.distance; };
    limits.push_back(std::min_element(&nearest[i], &nearest[i] + objects_, nearer)->distance);
  }
  std::vector<Match> of_background;
  if (background != nullptr) of_background = background->find(queries, 1, threads, limits.data());
  std::vector<Match> kept;
  for (std::size_t i = 0; i < nearest.size(); i += objects_) {
    const float to_background = of_background.empty() ? infinite : of_background[i / objects_].distance;
    keepNearly(&nearest[i], objects_, ambiguity, to_background, kept);
  }
  return kept;
}

}  // namespace sks
