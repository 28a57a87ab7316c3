// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sks {

/// K(u) = exp(-|u|^2 / 2) of eq. 3, without its constant: a vote at x itself counts 1. Maxima are followed in double
/// precision and out to 4 h, where the kernel is 0.0003. The evidence for poses asks for the density at each vote of a
/// scene, in single precision and out to 3 h (0.011), which are 2.4 times fewer neighbours; its scale is set for that.
template <typename Real>
class GaussianKernel {
public:
  /// @param bandwidth h [m] @param cutoff in bandwidths; beyond, the kernel counts as 0
  GaussianKernel(Real bandwidth, Real cutoff)
      : factor_(Real(-0.5) / (bandwidth * bandwidth)), reach_(cutoff * bandwidth) {}

  /// @param squared distance [m^2] within reach()
  Real operator()(Real squared) const { return std::exp(factor_ * squared); }
  /// [m]
  Real reach() const { return reach_; }

private:
  Real factor_, reach_;
};

/// For maxima.
inline GaussianKernel<double> shiftKernel(double bandwidth) {
  return {bandwidth, 4};
}

/// For densities at many positions.
inline GaussianKernel<float> densityKernel(double bandwidth) {
  return {float(bandwidth), 3};
}

}  // namespace sks
