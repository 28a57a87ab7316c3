// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_space.hpp"

#include <algorithm>
#include <cmath>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"

namespace sks::baselines {
namespace {

constexpr double most_bins = 5e7;  // some 2 GB

}  // namespace

HoughSpace::HoughSpace(const std::vector<Eigen::Vector3d>& votes, double bin_size) : bin_size_(bin_size) {
  Eigen::Vector3d high = votes.front();
  low_ = votes.front();
  for (const Eigen::Vector3d& vote : votes) {
    low_ = low_.cwiseMin(vote);
    high = high.cwiseMax(vote);
  }
  std::size_t size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::ceil(coordinate(high, axis) / bin_size);
    if (!(count * double(size) <= most_bins)) {
      throw Error(ErrorCode::bad_data,
                  "the votes lie so far apart that their Hough space would have too many bins of " + toText(bin_size) +
                      " m: crop the cloud (sanitize.max_range, sanitize.crop), or raise the method's bin size");
    }
    count_[std::size_t(axis)] = int(count);
    size *= std::size_t(count_[std::size_t(axis)]);
  }
  bins_.resize(size);
}

bool HoughSpace::binOf(const Eigen::Vector3d& position, std::array<int, 3>& bin) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bin[axis] = int(std::floor(coordinate(position, int(axis)) / bin_size_));
    if (bin[axis] < 0 || bin[axis] >= count_[axis]) return false;
  }
  return true;
}

void HoughSpace::vote(const Eigen::Vector3d& position, double weight, int voter) {
  std::array<int, 3> at;
  if (!binOf(position, at)) return;
  Bin& bin = bins_[indexOf(at)];
  bin.votes += weight;
  bin.voters.push_back(voter);
}

void HoughSpace::voteInterpolated(const Eigen::Vector3d& position, double weight, int voter) {
  std::array<int, 3> own;
  if (!binOf(position, own)) return;
  std::array<int, 3> step;                   // to the neighbour on whose side of the bin's centre the vote lies
  std::array<std::array<float, 2>, 3> part;  // of the vote along each axis: the own bin's, the neighbour's
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float center = float((2 * double(own[axis]) * bin_size_ + bin_size_) / 2);
    const double offset = coordinate(position, int(axis)) - center;
    const float own_part = float(1 - std::abs(offset) / bin_size_);
    step[axis] = offset < 0 ? -1 : 1;
    part[axis] = {own_part, 1 - own_part};
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<int, 3> at = own;
    float fraction = 1;
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const unsigned next = (corner >> axis) & 1;
      if (next != 0) at[axis] += step[axis];
      fraction *= part[axis][next];
      inside = inside && at[axis] >= 0 && at[axis] < count_[axis];
    }
    if (!inside) continue;
    Bin& bin = bins_[indexOf(at)];
    bin.votes += weight * double(fraction);
    bin.voters.push_back(voter);
  }
}

bool HoughSpace::isMaximum(const std::array<int, 3>& bin) const {
  const double votes = bins_[indexOf(bin)].votes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      std::array<int, 3> neighbor = bin;
      neighbor[axis] += step;
      const bool inside = neighbor[axis] >= 0 && neighbor[axis] < count_[axis];
      if (inside && votes < bins_[indexOf(neighbor)].votes) return false;
    }
  }
  return true;
}

std::vector<std::vector<int>> HoughSpace::maxima(double threshold) const {
  if (threshold < 0) {
    double highest = 0;
    for (const Bin& bin : bins_) highest = std::max(highest, bin.votes);
    threshold = std::min(-threshold, 1.0) * highest;
  }
  std::vector<std::vector<int>> found;
  std::array<int, 3> bin;
  for (bin[2] = 0; bin[2] < count_[2]; ++bin[2]) {
    for (bin[1] = 0; bin[1] < count_[1]; ++bin[1]) {
      for (bin[0] = 0; bin[0] < count_[0]; ++bin[0]) {
        const Bin& candidate = bins_[indexOf(bin)];
        if (candidate.votes >= threshold && isMaximum(bin)) found.push_back(candidate.voters);
      }
    }
  }
  return found;
}

}  // namespace sks::baselines
