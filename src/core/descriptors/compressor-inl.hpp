// SPDX-License-Identifier: BSD-3-Clause
// Moves the selected lanes of vectors to their front; for inclusion by kernels that Highway compiles once for each
// target.
#include <array>
#include <cstdint>

#ifndef SKS_COMPRESSOR_TABLE
#define SKS_COMPRESSOR_TABLE
namespace sks {

/// For each mask of eight lanes their numbers, the selected ones first. Of the masks of four lanes the first four.
struct CompressionTable {
  constexpr CompressionTable() {
    for (std::size_t mask = 0; mask < 256; ++mask) {
      std::size_t next = 0;
      for (const std::size_t selected : {1, 0}) {
        for (std::size_t lane = 0; lane < 8; ++lane) {
          if ((mask >> lane & 1) == selected) lanes[8 * mask + next++] = std::uint8_t(lane);
        }
      }
    }
  }
  std::uint8_t lanes[8 * 256] = {};
};

// Highway 1.0 keeps its own table in a function, from where GCC copies all of it to the stack at each call.
inline constexpr CompressionTable compression_table;

}  // namespace sks
#endif

#if defined(SKS_COMPRESSOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKS_COMPRESSOR_INL
#undef SKS_COMPRESSOR_INL
#else
#define SKS_COMPRESSOR_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Moves the lanes of 32 bits that a mask selects to the front of any number of vectors; the others follow.
template <class D>
class Compressor {
public:
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
  HWY_INLINE Compressor(D d, hn::Mask<D> mask) : mask_(mask), count_(hn::CountTrue(d, mask)) {}

  template <class V>
  HWY_INLINE V operator()(V v) const {
    return hn::Compress(v, hn::RebindMask(hn::DFromV<V>(), mask_));
  }
#else
  HWY_INLINE Compressor(D d, hn::Mask<D> mask) : indices_(indicesOf(d, mask)), count_(hn::CountTrue(d, mask)) {}

  template <class V>
  HWY_INLINE V operator()(V v) const {
    return hn::BitCast(hn::DFromV<V>(), hn::TableLookupLanes(hn::BitCast(D(), v), indices_));
  }
#endif

  /// Selected lanes.
  HWY_INLINE std::size_t count() const {
    return count_;
  }

private:
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
  hn::Mask<D> mask_;
#else
  using Indices = decltype(hn::IndicesFromVec(D(), hn::Zero(hn::RebindToUnsigned<D>())));

  static HWY_INLINE Indices indicesOf(D d, hn::Mask<D> mask) {
    static_assert(HWY_MAX_BYTES <= 32, "the table has masks of eight lanes");
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    const hn::RebindToUnsigned<D> d_wide;
    const hn::Rebind<std::uint8_t, D> d_narrow;
    return hn::IndicesFromVec(
        d, hn::PromoteTo(d_wide, hn::LoadU(d_narrow, &compression_table.lanes[8 * std::size_t(bits[0])])));
  }

  Indices indices_;
#endif
  std::size_t count_;
};

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#endif
