// SPDX-License-Identifier: BSD-3-Clause
#include "core/descriptors/shot_support.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/descriptors/shot_support.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void locateAll(const Neighborhood& in, const float* frame, float radius, ShotSupport& out) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto f = [&](int i) { return hn::Set(d, frame[i]); };  // column-major: axis k is f(k), f(k + 3), f(k + 6)
  const auto pi = hn::Set(d, 3.14159265358979f), zero = hn::Zero(d), half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
  const auto per_sector = hn::Set(d, 4.0f / 3.14159265358979f), per_half = hn::Set(d, 2.0f / 3.14159265358979f);
  const auto per_husk = hn::Set(d, 2.0f / radius), seven = hn::Set(d, 7.0f);
  for (std::size_t i = 0; i < in.size; i += hn::Lanes(d)) {
    const auto px = hn::LoadU(d, in.x.data() + i), py = hn::LoadU(d, in.y.data() + i),
               pz = hn::LoadU(d, in.z.data() + i);
    const auto dot = [&](int axis, auto a, auto b, auto c) {
      return hn::MulAdd(f(axis), a, hn::MulAdd(f(axis + 3), b, hn::Mul(f(axis + 6), c)));
    };
    const auto x = dot(0, px, py, pz), y = dot(1, px, py, pz), z = dot(2, px, py, pz);
    const auto distance = hn::LoadU(d, in.distance.data() + i);

    // Azimuth in [-pi, pi]; the arc tangent of a quotient of at most 1 keeps clear of the poles.
    const auto ax = hn::Abs(x), ay = hn::Abs(y);
    const auto small = hn::Min(ax, ay), large = hn::Max(ax, ay);
    auto angle = hn::Atan(d, hn::IfThenElseZero(hn::Gt(large, zero), hn::Div(small, large)));
    angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Mul(half, pi), angle), angle);
    angle = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(pi, angle), angle);
    angle = hn::CopySign(angle, y);
    const auto turn = hn::Mul(hn::Add(angle, pi), per_sector);  // 0 to 8
    const auto sector = hn::Min(hn::Floor(turn), seven);

    const auto shell = hn::Mul(distance, per_husk);  // 0 to 2
    const auto outer = hn::Gt(shell, one);
    const auto polar = hn::Acos(
        d, hn::Max(hn::Min(hn::IfThenElseZero(hn::Gt(distance, zero), hn::Div(z, distance)), one), hn::Neg(one)));
    const auto incline = hn::Mul(polar, per_half);  // 0 to 2, lower half beyond 1
    const auto upper = hn::Gt(z, zero);

    const auto bit = [&](auto mask, int value) {
      return hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, value));
    };
    const auto volume = hn::Add(hn::ShiftLeft<2>(hn::ConvertTo(di, sector)), hn::Add(bit(outer, 2), bit(upper, 1)));
    hn::StoreU(volume, di, out.volume.data() + i);
    hn::StoreU(hn::Sub(hn::Sub(turn, sector), half), d, out.azimuth.data() + i);
    hn::StoreU(hn::Sub(hn::Sub(shell, hn::IfThenElseZero(outer, one)), half), d, out.husk.data() + i);
    hn::StoreU(hn::Sub(hn::Sub(incline, hn::IfThenZeroElse(upper, one)), half), d, out.elevation.data() + i);
    hn::StoreU(dot(2, hn::LoadU(d, in.nx.data() + i), hn::LoadU(d, in.ny.data() + i), hn::LoadU(d, in.nz.data() + i)),
               d, out.cosine.data() + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(locateAll);

void ShotSupport::locate(const Neighborhood& neighborhood, const Eigen::Matrix3f& frame, float radius) {
  const std::size_t capacity = neighborhood.x.size();
  if (volume.size() < capacity) {
    volume.resize(capacity);
    for (auto* array : {&azimuth, &husk, &elevation, &cosine}) array->resize(capacity);
  }
  HWY_DYNAMIC_DISPATCH(locateAll)(neighborhood, frame.data(), radius, *this);
}

}  // namespace sks
#endif
