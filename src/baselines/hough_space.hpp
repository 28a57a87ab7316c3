// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace sks::baselines {

/// A grid of cubic bins that gathers weighted votes for a position, as pcl::recognition::HoughSpace3D does: its results
/// are the same. That class lies in a library which loads VTK.
class HoughSpace {
public:
  /// The bins cover the votes. @param votes [m], at least one @param bin_size [m]
  HoughSpace(const std::vector<Eigen::Vector3d>& votes, double bin_size);

  /// Adds to the bin of the vote. What lies on the upper border is dropped.
  void vote(const Eigen::Vector3d& position, double weight, int voter);

  /// Spreads the vote over the bins around it, by its distance to their centres.
  void voteInterpolated(const Eigen::Vector3d& position, double weight, int voter);

  /// The voters of each bin with at least `threshold` votes, and no fewer than the bins that it shares a face with.
  /// @param threshold negative: the fraction of the highest bin's votes
  std::vector<std::vector<int>> maxima(double threshold) const;

private:
  struct Bin {
    double votes = 0;
    std::vector<int> voters;
  };

  double coordinate(const Eigen::Vector3d& position, int axis) const { return position[axis] - low_[axis]; }
  bool binOf(const Eigen::Vector3d& position, std::array<int, 3>& bin) const;
  std::size_t indexOf(const std::array<int, 3>& bin) const {
    return (std::size_t(bin[2]) * std::size_t(count_[1]) + std::size_t(bin[1])) * std::size_t(count_[0]) +
           std::size_t(bin[0]);
  }
  bool isMaximum(const std::array<int, 3>& bin) const;

  Eigen::Vector3d low_;
  double bin_size_;
  std::array<int, 3> count_;
  std::vector<Bin> bins_;  // x fastest
};

}  // namespace sks::baselines
