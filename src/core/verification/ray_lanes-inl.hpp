// SPDX-License-Identifier: BSD-3-Clause
// Points of a stored surface, one in each SIMD lane, placed in a scene and projected into its range image; for
// inclusion by kernels that Highway compiles once for each target.
#if defined(SKS_RAY_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKS_RAY_LANES_INL
#undef SKS_RAY_LANES_INL
#else
#define SKS_RAY_LANES_INL
#endif

#include <hwy/highway.h>

#include "core/verification/range_image.hpp"
#include "core/verification/surface_sample.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, PointGrid::simd_padding>;
using Lane = hn::Vec<Lanes>;

struct Vector3 {
  Lane x, y, z;

  HWY_INLINE Vector3 operator-(const Vector3& o) const { return {hn::Sub(x, o.x), hn::Sub(y, o.y), hn::Sub(z, o.z)}; }
  HWY_INLINE Lane dot(const Vector3& o) const { return hn::MulAdd(x, o.x, hn::MulAdd(y, o.y, hn::Mul(z, o.z))); }
  HWY_INLINE Vector3 cross(const Vector3& o) const {
    return {hn::MulSub(y, o.z, hn::Mul(z, o.y)), hn::MulSub(z, o.x, hn::Mul(x, o.z)),
            hn::MulSub(x, o.y, hn::Mul(y, o.x))};
  }
};

HWY_INLINE Vector3 repeat(const Eigen::Vector3f& v) {
  const Lanes d;
  return {hn::Set(d, v.x()), hn::Set(d, v.y()), hn::Set(d, v.z())};
}

HWY_INLINE Vector3 keep(hn::Mask<Lanes> mask, const Vector3& v) {
  return {hn::IfThenElseZero(mask, v.x), hn::IfThenElseZero(mask, v.y), hn::IfThenElseZero(mask, v.z)};
}

/// `add` is 1 for points and 0 for directions.
HWY_INLINE Vector3 mapped(const RigidRows& T, const Vector3& v, float add) {
  const Lanes d;
  const auto row = [&](int i) {
    const auto last = hn::MulAdd(hn::Set(d, T(i, 2)), v.z, hn::Set(d, add * T(i, 3)));
    return hn::MulAdd(hn::Set(d, T(i, 0)), v.x, hn::MulAdd(hn::Set(d, T(i, 1)), v.y, last));
  };
  return {row(0), row(1), row(2)};
}

/// Numbers of the cells in the direction of places; `seen`: where there are any.
HWY_INLINE hn::Vec<hn::RebindToSigned<Lanes>> cellsOf(const RangeImage::Projection& image, const Vector3& place,
                                                      hn::Mask<Lanes>& seen) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto set = [&](float value) { return hn::Set(d, value); };
  const Vector3 ray = place - repeat(image.origin);
  const auto depth = ray.dot(repeat(image.axes.row(2)));
  seen = hn::Gt(depth, hn::Mul(set(RangeImage::rim), hn::Sqrt(ray.dot(ray))));
  const auto inverse = hn::Div(set(1.0f), hn::IfThenElse(seen, depth, set(1.0f)));
  const auto column = hn::Div(hn::MulSub(ray.dot(repeat(image.axes.row(0))), inverse, set(image.u0)), set(image.cell));
  const auto row = hn::Div(hn::MulSub(ray.dot(repeat(image.axes.row(1))), inverse, set(image.v0)), set(image.cell));
  const auto zero = hn::Zero(d);
  seen =
      hn::And(seen, hn::And(hn::And(hn::Ge(column, zero), hn::Ge(row, zero)),
                            hn::And(hn::Lt(column, set(float(image.width))), hn::Lt(row, set(float(image.height))))));
  const auto index = [&](auto v) { return hn::ConvertTo(di, hn::IfThenElseZero(seen, v)); };
  return hn::Add(hn::Mul(index(row), hn::Set(di, image.width)), index(column));
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#endif
