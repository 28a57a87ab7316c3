// SPDX-License-Identifier: BSD-3-Clause
// SHOT and CSHOT histograms (Tombari, Salti, Di Stefano 2010, 2011). Weights and neighbouring bins are those of PCL's
// implementation, so that descriptors of both agree.
//
// Each neighbour adds to five bins: its own, the adjacent bin of its value, husk, half and sector. What it adds is
// computed with one neighbour in each lane. A sector's four volumes (two husks, two halves) lie side by side in memory
// while the sums are formed, so that own bin, husk and half are one addition of a vector of four.
#include "core/descriptors/shot.hpp"

#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/descriptors/shot.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t block = 128;  // neighbours whose contributions are kept at a time

/// What some neighbours add, and where. Bins are numbered (sector * bins of a value + bin of the value) * 4 + volume in
/// the sector.
struct Contributions {
  float own[4 * block];                  ///< for each volume of the sector: own bin, husk and half
  std::int32_t own_bin[block];           ///< of the sector's first volume
  float adjacent[block], sector[block];  ///< to the adjacent bin of the value; to the adjacent sector
  std::int32_t adjacent_bin[block], sector_bin[block];
};

/// Sums in two copies each: neighbours that follow each other often fall into the same bins, and need not wait.
template <int bins>
struct Sums {
  static constexpr std::size_t size = std::size_t(32) * bins;
  float own[2][size] = {};
  float aside[2][size] = {};
};

/// Contributions of a vector of neighbours whose values lie at `position` in 0 to `steps`; NaN adds nothing.
template <int steps, class V>
HWY_INLINE void place(const ShotSupport& support, std::size_t i, V position, std::size_t slot, Contributions& out) {
  const hn::DFromV<V> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto zero = hn::Zero(d);
  const auto none = hn::Zero(di), one_i = hn::Set(di, 1), wrap = hn::Set(di, steps);
  const auto counts = hn::Eq(position, position);
  position = hn::IfThenElseZero(counts, position);
  const auto bin = hn::ConvertTo(di, hn::Add(position, hn::Set(d, 0.5f)));
  const auto offset = hn::Sub(position, hn::ConvertTo(d, bin)), away = hn::Abs(offset);

  const auto volume = hn::LoadU(di, support.volume.data() + i);
  const auto sector = hn::ShiftRight<2>(volume), part = hn::And(volume, hn::Set(di, 3));
  const auto outer = hn::Ne(hn::And(volume, hn::Set(di, 2)), none), upper = hn::Ne(hn::And(volume, one_i), none);
  const auto azimuth = hn::LoadU(d, support.azimuth.data() + i), turn = hn::Abs(azimuth);
  const auto husk = hn::LoadU(d, support.husk.data() + i), elevation = hn::LoadU(d, support.elevation.data() + i);
  // Towards the rim, the centre and the poles there is no further volume: what belongs there is left out.
  const auto to_husk = hn::Max(hn::IfThenElse(hn::RebindMask(d, outer), hn::Neg(husk), husk), zero);
  const auto to_half = hn::Max(hn::IfThenElse(hn::RebindMask(d, upper), elevation, hn::Neg(elevation)), zero);
  const auto rest = hn::Sub(hn::Set(d, 4.0f), hn::Add(hn::Add(away, hn::Abs(husk)), hn::Add(hn::Abs(elevation), turn)));

  const auto in_sector = [&](int k) {
    const auto distance = hn::Xor(part, hn::Set(di, k));
    const auto at = [&](int which, auto value, auto otherwise) {
      return hn::IfThenElse(hn::RebindMask(d, hn::Eq(distance, hn::Set(di, which))), value, otherwise);
    };
    return hn::IfThenElseZero(counts, at(0, rest, at(2, to_husk, at(1, to_half, zero))));
  };
  hn::StoreInterleaved4(in_sector(0), in_sector(1), in_sector(2), in_sector(3), d, out.own + 4 * slot);

  const auto number = [&](auto in, auto value_bin) {
    return hn::ShiftLeft<2>(hn::Add(hn::Mul(in, hn::Set(di, steps + 1)), value_bin));
  };
  // PCL wraps at `steps`, not at the number of bins; kept for equal descriptors.
  const auto next = hn::Add(bin, one_i), previous = hn::Sub(bin, one_i);
  const auto after = hn::IfThenElse(hn::Lt(next, wrap), next, hn::Sub(next, wrap));
  const auto before = hn::IfThenElse(hn::Lt(previous, none), hn::Add(previous, wrap), previous);
  const auto adjacent = hn::IfThenElse(hn::RebindMask(di, hn::Gt(offset, zero)), after, before);
  const auto towards = hn::IfThenElse(hn::RebindMask(di, hn::Gt(azimuth, zero)), one_i, hn::Set(di, 7));
  const auto next_sector = hn::And(hn::Add(sector, towards), hn::Set(di, 7));
  hn::StoreU(number(sector, bin), di, out.own_bin + slot);
  hn::StoreU(hn::Add(number(sector, adjacent), part), di, out.adjacent_bin + slot);
  hn::StoreU(hn::Add(number(next_sector, bin), part), di, out.sector_bin + slot);
  hn::StoreU(hn::IfThenElseZero(counts, away), d, out.adjacent + slot);
  hn::StoreU(hn::IfThenElseZero(counts, turn), d, out.sector + slot);
}

template <int bins>
HWY_INLINE void add(const Contributions& from, std::size_t count, Sums<bins>& sums) {
  const hn::CappedTag<float, 4> d;
  for (std::size_t i = 0; i < count; ++i) {
    float* own = sums.own[i % 2] + from.own_bin[i];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d)) {
      hn::StoreU(hn::Add(hn::LoadU(d, own + k), hn::LoadU(d, from.own + 4 * i + k)), d, own + k);
    }
    sums.aside[0][from.adjacent_bin[i]] += from.adjacent[i];
    sums.aside[1][from.sector_bin[i]] += from.sector[i];
  }
}

/// Histograms of the values at `position(d, index of the first of a vector of neighbours)`.
template <int steps, class Position>
HWY_INLINE void histogramOf(const Neighborhood& n, const ShotSupport& support, Position position, float* histogram) {
  constexpr int bins = steps + 1;
  const hn::CappedTag<float, PointGrid::simd_padding> d;
  const auto nan = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  Contributions contributions;
  Sums<bins> sums;
  for (std::size_t begin = 0; begin < n.size; begin += block) {
    const std::size_t count = n.size - begin < block ? n.size - begin : block;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      const auto apart = hn::And(hn::Gt(hn::LoadU(d, n.distance.data() + begin + i), hn::Zero(d)),
                                 hn::FirstN(d, count - i));  // the keypoint's own place has no direction
      place<steps>(support, begin + i, hn::IfThenElse(apart, position(d, begin + i), nan), i, contributions);
    }
    add(contributions, count, sums);
  }
  for (int volume = 0; volume < 32; ++volume) {
    for (int bin = 0; bin < bins; ++bin) {
      const int k = ((volume / 4) * bins + bin) * 4 + volume % 4;
      histogram[volume * bins + bin] = (sums.own[0][k] + sums.own[1][k]) + (sums.aside[0][k] + sums.aside[1][k]);
    }
  }
}

void shapeHistogramImpl(const Neighborhood& n, const ShotSupport& support, float* histogram) {
  constexpr int steps = 10;
  histogramOf<steps>(
      n, support,
      [&](auto d, std::size_t i) {
        const auto one = hn::Set(d, 1.0f), cosine = hn::LoadU(d, support.cosine.data() + i);
        const auto clamped = hn::Max(hn::Min(cosine, one), hn::Neg(one));
        const auto position = hn::MulAdd(clamped, hn::Set(d, 0.5f * steps), hn::Set(d, 0.5f * steps));
        return hn::IfThenElse(hn::Eq(cosine, cosine), position, cosine);
      },
      histogram);
}

void colorHistogramImpl(const float* colors, const float* own, const Neighborhood& n, const ShotSupport& support,
                        float* histogram) {
  constexpr int steps = 30;
  histogramOf<steps>(
      n, support,
      [&](auto d, std::size_t i) {
        const hn::RebindToSigned<decltype(d)> di;
        const auto used = hn::RebindMask(di, hn::FirstN(d, n.size - i));
        const auto index = hn::IfThenElseZero(used, hn::LoadU(di, reinterpret_cast<const std::int32_t*>(&n.index[i])));
        const auto at = hn::Add(index, hn::Add(index, index));
        const auto difference = [&](int k) {
          return hn::Abs(hn::Sub(hn::Set(d, own[k]), hn::GatherIndex(d, colors + k, at)));
        };
        const auto distance = hn::MulAdd(hn::Set(d, 0.5f), hn::Add(difference(1), difference(2)), difference(0));
        return hn::Min(hn::Mul(distance, hn::Set(d, steps / 3.0f)), hn::Set(d, float(steps)));
      },
      histogram);
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(shapeHistogramImpl);
HWY_EXPORT(colorHistogramImpl);

void shapeHistogram(const Neighborhood& neighborhood, const ShotSupport& support, float* histogram) {
  HWY_DYNAMIC_DISPATCH(shapeHistogramImpl)(neighborhood, support, histogram);
}

void colorHistogram(const Surface& surface, const Neighborhood& n, const ShotSupport& support, float core_radius,
                    float* histogram) {
  std::array<float, 3> own{};
  std::size_t count = 0, nearest = 0;
  for (std::size_t i = 0; i < n.size; ++i) {
    if (n.distance[i] < n.distance[nearest]) nearest = i;
    if (n.distance[i] > core_radius) continue;
    ++count;
    for (int k = 0; k < 3; ++k) own[k] += surface.color[n.index[i]][k];
  }
  for (int k = 0; k < 3; ++k) own[k] = count > 0 ? own[k] / float(count) : surface.color[n.index[nearest]][k];
  HWY_DYNAMIC_DISPATCH(colorHistogramImpl)(surface.color[0].data(), own.data(), n, support, histogram);
}

bool normalize(float* histogram, std::size_t size) {
  Eigen::Map<Eigen::VectorXf> values(histogram, Eigen::Index(size));
  const float norm = values.norm();
  if (!(norm > 0)) return false;
  values *= 1.0f / norm;
  return true;
}

}  // namespace sks
#endif
