// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/hellinger_axes.hpp"

#include <algorithm>
#include <random>

#include <Eigen/QR>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/matching/hellinger_axes.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// sums += factors[i] * (the `columns` numbers from table + rows[i] on); `columns` is a multiple of 64.
void addRowsImpl(const float* table, const std::uint32_t* rows, const float* factors, std::size_t count,
                 std::size_t columns, float* sums) {
  const hn::CappedTag<float, 16> d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t column = 0; column < columns; column += 4 * lanes) {
    const auto load = [&](const float* from, std::size_t k) { return hn::LoadU(d, from + column + k * lanes); };
    auto sum0 = load(sums, 0), sum1 = load(sums, 1), sum2 = load(sums, 2), sum3 = load(sums, 3);
    for (std::size_t i = 0; i < count; ++i) {
      const auto factor = hn::Set(d, factors[i]);
      const float* row = table + rows[i];
      sum0 = hn::MulAdd(factor, load(row, 0), sum0);
      sum1 = hn::MulAdd(factor, load(row, 1), sum1);
      sum2 = hn::MulAdd(factor, load(row, 2), sum2);
      sum3 = hn::MulAdd(factor, load(row, 3), sum3);
    }
    hn::StoreU(sum0, d, sums + column);
    hn::StoreU(sum1, d, sums + column + lanes);
    hn::StoreU(sum2, d, sums + column + 2 * lanes);
    hn::StoreU(sum3, d, sums + column + 3 * lanes);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(addRowsImpl);

namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t sample_size = 2048;  // words that the axes are learned from
constexpr int power_iterations = 3;

/// Square roots of some words, without the zeros, which are most of them.
class SparseRoots {
public:
  explicit SparseRoots(const SearchedWords& words) : bins_(words.cols()), mean_(Eigen::VectorXf::Zero(words.cols())) {
    const std::size_t rows = std::min(words.rows(), sample_size);
    std::vector<float> buffer;
    for (std::size_t row = 0; row < rows; ++row) {
      const float* word = words.row(row * words.rows() / rows, buffer);
      for (std::size_t bin = 0; bin < bins_; ++bin) {
        if (word[bin] == 0) continue;
        entries_.push_back({std::uint32_t(bin), std::sqrt(word[bin])});
        mean_[bin] += entries_.back().root / float(rows);
        mean_mass_ += word[bin] / float(rows);
      }
      ends_.push_back(entries_.size());
    }
  }

  const Eigen::VectorXf& mean() const { return mean_; }
  float meanMass() const { return mean_mass_; }

  /// X axes, X being the roots less their mean, one row a word.
  RowMajor times(const RowMajor& axes) const {
    RowMajor product = (-(mean_.transpose() * axes)).replicate(ends_.size(), 1);
    forEachEntry([&](std::size_t row, std::size_t bin, float root) { product.row(row) += root * axes.row(bin); });
    return product;
  }

  /// X^T factors
  RowMajor transposedTimes(const RowMajor& factors) const {
    RowMajor product = -mean_ * factors.colwise().sum();
    forEachEntry([&](std::size_t row, std::size_t bin, float root) { product.row(bin) += root * factors.row(row); });
    return product;
  }

private:
  struct Entry {
    std::uint32_t bin;
    float root;
  };

  template <typename Function>
  void forEachEntry(Function&& f) const {
    std::size_t entry = 0;
    for (std::size_t row = 0; row < ends_.size(); ++row) {
      for (; entry < ends_[row]; ++entry) f(row, entries_[entry].bin, entries_[entry].root);
    }
  }

  std::size_t bins_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> ends_;  // of each row's entries
  Eigen::VectorXf mean_;
  float mean_mass_ = 0;
};

RowMajor orthonormalized(const RowMajor& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> decomposition(columns);
  return decomposition.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

RowMajor randomColumns(std::size_t rows, std::size_t columns) {
  std::mt19937 random(1);
  RowMajor values(rows, columns);
  for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = float(random() >> 8) / float(1 << 23) - 1.0f;
  return values;
}

}  // namespace

HellingerAxes::HellingerAxes(const SearchedWords& words, std::size_t count) {
  const SparseRoots roots(words);
  mean_ = roots.mean();
  mean_mass_ = roots.meanMass();
  RowMajor axes = orthonormalized(randomColumns(words.cols(), std::min(count, words.cols())));
  for (int i = 0; i < power_iterations; ++i) axes = orthonormalized(roots.transposedTimes(roots.times(axes)));
  stride_ = (std::size_t(axes.cols()) + 63) / 64 * 64;
  axes_.assign(words.cols() * stride_, 0.0f);
  for (Eigen::Index bin = 0; bin < axes.rows(); ++bin) {
    std::copy_n(axes.row(bin).data(), axes.cols(), &axes_[std::size_t(bin) * stride_]);
  }
  mean_coordinates_ = Eigen::VectorXf::Zero(Eigen::Index(stride_));
  mean_coordinates_.head(axes.cols()) = axes.transpose() * mean_;
}

void HellingerAxes::project(const float* histogram, Projection& projection) const {
  projection.coordinates = -mean_coordinates_;
  projection.squares = mean_.squaredNorm();
  projection.mass = 0;
  projection.roots.clear();
  projection.rows.clear();
  for (Eigen::Index bin = 0; bin < mean_.size(); ++bin) {
    if (!(histogram[bin] > 0)) continue;
    const float root = std::sqrt(histogram[bin]);
    projection.roots.push_back(root);
    projection.rows.push_back(std::uint32_t(std::size_t(bin) * stride_));
    projection.squares += root * (root - 2 * mean_[bin]);
    projection.mass += histogram[bin];
  }
  HWY_DYNAMIC_DISPATCH(addRowsImpl)
  (axes_.data(), projection.rows.data(), projection.roots.data(), projection.roots.size(), stride_,
   projection.coordinates.data());
  projection.squares = std::max(projection.squares, 0.0f);
}

}  // namespace sks
#endif
