// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_pattern.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double prior_correlation = 0.3;           // keeps the fraction of weak patterns near 1
const Eigen::Array3d pattern_units(100, 120, 120);  // of the scaled colours

}  // namespace

void ColorPattern::add(const Eigen::Vector3f& model, const Eigen::Vector3f& scene) {
  const Eigen::Array3d m = model.array().cast<double>() * pattern_units;
  const Eigen::Array3d s = scene.array().cast<double>() * pattern_units;
  count_ += 1;
  model_ += m, scene_ += s;
  model_squares_ += m * m, scene_squares_ += s * s;
  products_ += m * s;
}

double ColorPattern::variance(const Eigen::Array3d& sum, const Eigen::Array3d& squares) const {
  return count_ > 0 ? std::max(0.0, (squares - sum * sum / count_).sum() / count_) : 0;
}

double ColorPattern::correlation() const {
  const double spread = std::sqrt(variance(model_, model_squares_) * variance(scene_, scene_squares_));
  if (!(spread > 0)) return 0;
  const double covariance = (products_ - model_ * scene_ / count_).sum() / count_;
  return std::clamp(covariance / spread, -1.0, 1.0);
}

double ColorPattern::agreement(double noise) const {
  const double signal = variance(model_, model_squares_);
  if (!(signal > 0)) return 1;
  // The mesh's print is blurred and displaced: as much noise as there is signal.
  const double expected = std::sqrt(signal / (signal + signal + noise * noise));
  return std::min(1.0, (std::max(0.0, correlation()) + prior_correlation) / (expected + prior_correlation));
}

}  // namespace sks
