// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/distinct_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <utility>

#include "core/surface/counting_sort.hpp"

namespace sks {
namespace {

/// A part of a position's hash in the upper half, by which entries are sorted, and the place in `indices` in the lower.
using HashedPlace = std::uint64_t;

constexpr int hash_bits = 32;
constexpr std::size_t points_per_bucket = 16;  // about
constexpr int most_bucket_bits = 16;
constexpr std::size_t worth_sharing = 50000;  // points that threads are started for

std::uint32_t hashOf(const Eigen::Vector3f& point) {
  const Eigen::Vector3f p = point + Eigen::Vector3f::Zero();  // -0 becomes +0
  std::uint32_t bits[3];
  std::memcpy(bits, p.data(), sizeof bits);
  std::uint64_t mixed =
      bits[0] * 0x9E3779B97F4A7C15ull ^ bits[1] * 0xC2B2AE3D27D4EB4Full ^ bits[2] * 0x165667B19E3779F9ull;
  mixed = (mixed ^ mixed >> 32) * 0x9E3779B97F4A7C15ull;
  return std::uint32_t((mixed ^ mixed >> 29) >> 32);
}

std::uint32_t placeOf(HashedPlace entry) {
  return std::uint32_t(entry);
}

bool sameHash(HashedPlace a, HashedPlace b) {
  return a >> hash_bits == b >> hash_bits;
}

/// Equal positions have equal hashes: they are in one bucket, and neighbours once that is sorted. Sorting takes little
/// time where buckets are small, and n log n steps even if all points are in one.
class BucketSearch {
public:
  BucketSearch(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint32_t>& indices,
               std::vector<char>& distinct)
      : points_(points), indices_(indices), distinct_(distinct) {}

  void markDuplicates(HashedPlace* begin, HashedPlace* end) const {
    std::sort(begin, end);
    for (HashedPlace* first = begin; first != end;) {
      HashedPlace* last = first + 1;
      while (last != end && sameHash(*first, *last)) ++last;
      if (last - first > 1) markOfOneHash(first, last);
      first = last;
    }
  }

private:
  const Eigen::Vector3f& at(HashedPlace entry) const { return points_[indices_[placeOf(entry)]]; }

  void markOfOneHash(HashedPlace* begin, HashedPlace* end) const {
    std::sort(begin, end, [&](HashedPlace a, HashedPlace b) {
      const Eigen::Vector3f &p = at(a), &q = at(b);
      return std::make_tuple(p.x(), p.y(), p.z(), a) < std::make_tuple(q.x(), q.y(), q.z(), b);
    });
    for (HashedPlace* i = begin + 1; i != end; ++i) {
      if (at(*i) == at(*(i - 1))) distinct_[placeOf(*i)] = 0;
    }
  }

  const std::vector<Eigen::Vector3f>& points_;
  const std::vector<std::uint32_t>& indices_;
  std::vector<char>& distinct_;
};

/// Which hashes come more than once, but for chance: a bit for each of many values of a part of the hash. Few points of
/// an ordinary cloud are left to be looked at closely.
class HashCounts {
public:
  HashCounts(const std::vector<std::uint32_t>& hashes, int threads) {
    while (bits_ < most_bits && std::size_t(1) << bits_ < bits_per_point * hashes.size()) ++bits_;
    once_.assign(std::size_t(1) << (bits_ - word_bits), 0);
    twice_ = once_;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int share = 0; share < threads; ++share) count(hashes, std::uint64_t(share), std::uint64_t(threads));
  }

  bool comesAgain(std::uint32_t hash) const {
    return (twice_[wordOf(hash)] & maskOf(hash)) != 0;
  }

private:
  static constexpr int word_bits = 6, most_bits = 30;
  static constexpr std::size_t bits_per_point = 16;

  std::size_t wordOf(std::uint32_t hash) const {
    return hash >> (hash_bits - bits_ + word_bits);
  }
  std::uint64_t maskOf(std::uint32_t hash) const {
    return std::uint64_t(1) << ((hash >> (hash_bits - bits_)) & ((1u << word_bits) - 1));
  }

  /// Counts the hashes of one share of the words, which no other thread writes.
  void count(const std::vector<std::uint32_t>& hashes, std::uint64_t share, std::uint64_t shares) {
    constexpr std::size_t block = 64;
    const std::uint64_t words = once_.size(), first = words * share / shares,
                        own = words * (share + 1) / shares - first;
    std::array<std::uint32_t, block> waiting;
    for (std::size_t begin = 0; begin < hashes.size(); begin += block) {
      std::size_t taken = 0;
      for (std::size_t i = begin; i < std::min(begin + block, hashes.size()); ++i) {  // without branches
        waiting[taken] = hashes[i];
        taken += wordOf(hashes[i]) - first < own ? 1 : 0;
      }
      for (std::size_t k = 0; k < taken; ++k) {
        const std::size_t word = wordOf(waiting[k]);
        const std::uint64_t mask = maskOf(waiting[k]);
        twice_[word] |= once_[word] & mask;
        once_[word] |= mask;
      }
    }
  }

  int bits_ = word_bits + 4;
  std::vector<std::uint64_t> once_, twice_;
};

/// Sorts entries into buckets and looks for duplicates in each.
void markDuplicates(std::vector<HashedPlace> entries, const BucketSearch& search, int threads) {
  int bits = 1;
  while (bits < most_bucket_bits && points_per_bucket << bits < entries.size()) ++bits;
  std::vector<std::uint32_t> begin;
  const std::size_t buckets = std::size_t(1) << bits;
  const auto bucketOf = [bits](HashedPlace entry) { return std::size_t(entry >> (64 - bits)); };
  entries = sortedByKey(entries, buckets, bucketOf, threads, begin);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads)
  for (std::size_t b = 0; b < buckets; ++b) {
    search.markDuplicates(entries.data() + begin[b], entries.data() + begin[b + 1]);
  }
}

}  // namespace

std::vector<std::uint32_t> distinctPoints(const std::vector<Eigen::Vector3f>& points,
                                          const std::vector<std::uint32_t>& indices, int threads) {
  const std::size_t n = indices.size();
  std::vector<std::uint32_t> hashes(n);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) hashes[i] = hashOf(points[indices[i]]);
  const HashCounts counts(hashes, threads);
  std::vector<char> distinct(n);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) distinct[i] = !counts.comesAgain(hashes[i]);

  std::vector<HashedPlace> doubtful;
  for (std::size_t i = 0; i < n; ++i) {
    if (distinct[i]) continue;
    doubtful.push_back(std::uint64_t(hashes[i]) << hash_bits | i);
    distinct[i] = 1;
  }
  const int enough = doubtful.size() < worth_sharing ? 1 : threads;
  markDuplicates(std::move(doubtful), BucketSearch(points, indices, distinct), enough);

  std::vector<std::uint32_t> kept(n);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {  // without branches
    kept[count] = indices[i];
    count += std::size_t(distinct[i]);
  }
  kept.resize(count);
  return kept;
}

}  // namespace sks
