// SPDX-License-Identifier: BSD-3-Clause
// Smallest eigenvectors of many symmetric 3 x 3 matrices at once; for inclusion by kernels that Highway compiles once
// for each target.
#if defined(SKS_SMALLEST_EIGENVECTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKS_SMALLEST_EIGENVECTOR_INL
#undef SKS_SMALLEST_EIGENVECTOR_INL
#else
#define SKS_SMALLEST_EIGENVECTOR_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One symmetric matrix in each lane.
template <class V>
struct SymmetricMatrices {
  V xx, xy, xz, yy, yz, zz;
};

/// Smallest root of the characteristic polynomial of matrices with trace 1, no eigenvalue negative.
template <class D, class V>
HWY_INLINE V smallestEigenvalue(D d, const SymmetricMatrices<V>& m) {
  const V minors = hn::Sub(hn::MulAdd(m.xx, m.yy, hn::MulAdd(m.xx, m.zz, hn::Mul(m.yy, m.zz))),
                           hn::MulAdd(m.xy, m.xy, hn::MulAdd(m.xz, m.xz, hn::Mul(m.yz, m.yz))));
  const V yz = hn::Sub(hn::Mul(m.yy, m.zz), hn::Mul(m.yz, m.yz));
  const V xz = hn::Sub(hn::Mul(m.xy, m.zz), hn::Mul(m.yz, m.xz));
  const V xy = hn::Sub(hn::Mul(m.xy, m.yz), hn::Mul(m.yy, m.xz));
  const V determinant = hn::MulAdd(m.xz, xy, hn::NegMulAdd(m.xy, xz, hn::Mul(m.xx, yz)));

  // Newton's method climbs from 0 to the smallest root; a flat patch needs few steps.
  const V one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), three = hn::Set(d, 3.0), tolerance = hn::Set(d, 1e-14);
  V root = hn::Zero(d);
  for (int i = 0; i < 30; ++i) {
    const V slope = hn::MulAdd(hn::MulSub(three, root, two), root, minors);
    const V value = hn::MulSub(hn::MulAdd(hn::Sub(root, one), root, minors), root, determinant);
    const V step = hn::IfThenElseZero(hn::Gt(slope, hn::Zero(d)), hn::Div(value, slope));
    root = hn::Sub(root, step);
    if (hn::AllTrue(d, hn::Le(hn::Abs(step), tolerance))) break;
  }
  return root;
}

/// Unit eigenvectors (x, y, z) of the smallest eigenvalues. @return how well each is determined: not at all (below
/// 1e-12, or NaN) for points along a line, or in a ball
template <class D, class V>
HWY_INLINE V smallestEigenvectors(D d, SymmetricMatrices<V> m, V& x, V& y, V& z) {
  const V scale = hn::Div(hn::Set(d, 1.0), hn::Add(m.xx, hn::Add(m.yy, m.zz)));
  for (V* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *entry = hn::Mul(*entry, scale);
  const V root = smallestEigenvalue(d, m);
  for (V* entry : {&m.xx, &m.yy, &m.zz}) *entry = hn::Sub(*entry, root);

  // The shifted matrix has rank 2: its columns span the plane, and the longest of their products is the most exact.
  V longest = hn::Set(d, -1.0);
  const auto consider = [&](V ax, V ay, V az, V bx, V by, V bz) {
    const V cx = hn::Sub(hn::Mul(ay, bz), hn::Mul(az, by));
    const V cy = hn::Sub(hn::Mul(az, bx), hn::Mul(ax, bz));
    const V cz = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
    const V squared = hn::MulAdd(cx, cx, hn::MulAdd(cy, cy, hn::Mul(cz, cz)));
    const auto better = hn::Gt(squared, longest);
    longest = hn::IfThenElse(better, squared, longest);
    x = hn::IfThenElse(better, cx, x);
    y = hn::IfThenElse(better, cy, y);
    z = hn::IfThenElse(better, cz, z);
  };
  consider(m.xx, m.xy, m.xz, m.xy, m.yy, m.yz);
  consider(m.xx, m.xy, m.xz, m.xz, m.yz, m.zz);
  consider(m.xy, m.yy, m.yz, m.xz, m.yz, m.zz);
  const V length = hn::Sqrt(longest);
  for (V* axis : {&x, &y, &z}) *axis = hn::Div(*axis, length);
  return longest;
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#endif
