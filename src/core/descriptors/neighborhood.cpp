// SPDX-License-Identifier: BSD-3-Clause
#include "core/descriptors/neighborhood.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/descriptors/neighborhood.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/descriptors/compressor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Appends those points of a run that lie within the radius; returns the new count.
std::size_t gatherRun(const Surface& surface, const float* center, float radius, PointGrid::Run run, Neighborhood& out,
                      std::size_t count) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const auto cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  const auto limit = hn::Set(d, radius * radius);
  for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
    const auto x = hn::Sub(hn::LoadU(d, surface.x.data() + i), cx);
    const auto y = hn::Sub(hn::LoadU(d, surface.y.data() + i), cy);
    const auto z = hn::Sub(hn::LoadU(d, surface.z.data() + i), cz);
    const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const Compressor<decltype(d)> compress(d, hn::And(hn::Le(squared, limit), hn::FirstN(d, run.end - i)));
    const auto keep = [&](auto v, auto* array) { hn::StoreU(compress(v), hn::DFromV<decltype(v)>(), array + count); };
    keep(x, out.x.data());
    keep(y, out.y.data());
    keep(z, out.z.data());
    keep(hn::Sqrt(squared), out.distance.data());
    keep(hn::LoadU(d, surface.nx.data() + i), out.nx.data());
    keep(hn::LoadU(d, surface.ny.data() + i), out.ny.data());
    keep(hn::LoadU(d, surface.nz.data() + i), out.nz.data());
    keep(hn::Iota(du, std::uint32_t(i)), out.index.data());
    count += compress.count();
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(gatherRun);

void Neighborhood::gather(const Surface& surface, const Eigen::Vector3f& center, float radius) {
  surface.findRuns(center, radius, runs);
  std::size_t capacity = PointGrid::simd_padding;  // a compressing store may write a whole vector
  for (const auto& run : runs) capacity += run.end - run.begin;
  if (index.size() < capacity) {
    for (auto* array : {&x, &y, &z, &distance, &nx, &ny, &nz}) array->resize(2 * capacity);
    index.resize(2 * capacity);
  }
  size = 0;
  for (const auto& run : runs) size = HWY_DYNAMIC_DISPATCH(gatherRun)(surface, center.data(), radius, run, *this, size);
}

void Neighborhood::keepFacing(float min_cosine, float core_radius) {
  Eigen::Vector3f own = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < size; ++i) {
    if (distance[i] <= core_radius && !std::isnan(nx[i])) own += Eigen::Vector3f(nx[i], ny[i], nz[i]);
  }
  own.normalize();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (!(own.dot(Eigen::Vector3f(nx[i], ny[i], nz[i])) >= min_cosine)) continue;
    for (auto* array : {&x, &y, &z, &distance, &nx, &ny, &nz}) (*array)[kept] = (*array)[i];
    index[kept++] = index[i];
  }
  size = kept;
}

}  // namespace sks
#endif
