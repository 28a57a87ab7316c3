// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/distinct_points.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "core/surface/counting_sort.hpp"

namespace sks {
namespace {

/// A part of a position's hash in the upper half, by which entries are sorted, and the place in `indices` in the lower.
using HashedPlace = std::uint64_t;

constexpr int hash_bits = 32;
constexpr std::size_t points_per_bucket = 16;  // about
constexpr int most_bucket_bits = 16;

std::uint64_t hashOf(const Eigen::Vector3f& point) {
  const Eigen::Vector3f p = point + Eigen::Vector3f::Zero();  // -0 becomes +0
  std::uint32_t bits[3];
  std::memcpy(bits, p.data(), sizeof bits);
  std::uint64_t mixed =
      bits[0] * 0x9E3779B97F4A7C15ull ^ bits[1] * 0xC2B2AE3D27D4EB4Full ^ bits[2] * 0x165667B19E3779F9ull;
  mixed = (mixed ^ mixed >> 32) * 0x9E3779B97F4A7C15ull;
  return mixed ^ mixed >> 29;
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

}  // namespace

std::vector<std::uint32_t> distinctPoints(const std::vector<Eigen::Vector3f>& points,
                                          const std::vector<std::uint32_t>& indices, int threads) {
  const std::size_t n = indices.size();
  std::vector<HashedPlace> entries(n);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) entries[i] = hashOf(points[indices[i]]) >> hash_bits << hash_bits | i;

  int bits = 1;
  while (bits < most_bucket_bits && points_per_bucket << bits < n) ++bits;
  std::vector<std::uint32_t> begin;
  const std::size_t buckets = std::size_t(1) << bits;
  const auto bucketOf = [bits](HashedPlace entry) { return std::size_t(entry >> (64 - bits)); };
  entries = sortedByKey(entries, buckets, bucketOf, threads, begin);
  std::vector<char> distinct(n, 1);
  const BucketSearch search(points, indices, distinct);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads)
  for (std::size_t b = 0; b < buckets; ++b) {
    search.markDuplicates(entries.data() + begin[b], entries.data() + begin[b + 1]);
  }

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
