// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/matching/searched_words.hpp"

namespace sks {

/// Orthonormal axes along which the square roots of histograms vary most.
///
/// The squared distance of the square roots (twice the squared Hellinger distance) is never above chi squared, and a
/// projection on orthonormal axes, with what it leaves over as one more coordinate, can only lower it: coordinates on a
/// few axes give lower bounds of chi squared as plain squared distances.
class HellingerAxes {
public:
  HellingerAxes() = default;
  /// Learns at most `count` axes from (a sample of) the words; fewer if the descriptors have fewer bins. Deterministic.
  HellingerAxes(const SearchedWords& words, std::size_t count);

  /// Mean sum of a word.
  float meanMass() const { return mean_mass_; }

  /// The roots of a histogram, less their mean.
  struct Projection {
    Eigen::VectorXf coordinates;
    float squares;  ///< of all coordinates and of what is left over together
    float mass;     ///< sum of the histogram; rounding errors of `squares` are in proportion to it

    /// Roots of the bins that are not empty, and where their axes begin.
    std::vector<float> roots;
    std::vector<std::uint32_t> rows;
  };
  void project(const float* histogram, Projection& projection) const;

private:
  std::vector<float> axes_;  // bin by bin, padded with zeros to `stride_` for each
  std::size_t stride_ = 0;
  Eigen::VectorXf mean_;  // of the roots
  Eigen::VectorXf mean_coordinates_;
  float mean_mass_ = 0;
};

}  // namespace sks
