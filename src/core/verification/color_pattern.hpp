// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace sks {

/// Whether the colours of a model and of the scene vary together over the surface. Light, exposure and white balance
/// move and scale all colours of an object, but leave the pattern: a print, a handle of another colour. Another box of
/// similar colours has another pattern.
class ColorPattern {
public:
  /// The colours at one point of the surface; as in Surface.
  void add(const Eigen::Vector3f& model, const Eigen::Vector3f& scene);

  /// Pearson correlation in [-1, 1], all three channels together; 0 where one of the two does not vary.
  double correlation() const;

  /// In (0, 1]: the correlation over what is to be expected of a pattern that is so much stronger than the noise. About
  /// 1 for a model of one colour, which cannot be told apart by a pattern.
  /// @param noise of scene colours around those of the model, in units of CIELab
  double agreement(double noise) const;

private:
  double variance(const Eigen::Array3d& sum, const Eigen::Array3d& squares) const;

  double count_ = 0;
  Eigen::Array3d model_ = Eigen::Array3d::Zero(), scene_ = Eigen::Array3d::Zero();  // sums, in units of CIELab
  Eigen::Array3d model_squares_ = Eigen::Array3d::Zero(), scene_squares_ = Eigen::Array3d::Zero();
  Eigen::Array3d products_ = Eigen::Array3d::Zero();
};

}  // namespace sks
