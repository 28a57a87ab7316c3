// SPDX-License-Identifier: BSD-3-Clause
// Captured views are tied by how the camera was moved where pictures do not tell it.
#include <sks_detector/registration.hpp>

#include <vector>

#include <gtest/gtest.h>

#include "table_view.hpp"

namespace sks {
namespace {

using test::TableView;

constexpr int views = 8;

std::vector<double> directions() {
  std::vector<double> degrees;
  for (int i = 0; i < views; ++i) degrees.push_back(20 + 45 * i);
  return degrees;
}

/// Views of a mug, whose handle half of them do not show, from a camera whose poses are off by a turn about the
/// vertical that grows from view to view, as those of odometry are.
std::vector<TrainingSample> mugWithMotion(const TableView& mug, double drift) {
  std::vector<TrainingSample> samples;
  for (const double degrees : directions()) {
    samples.push_back(mug.capture(degrees));
    samples.back().T_fixed_source = test::turnedBy(drift * double(samples.size())) * mug.T_table_camera(degrees);
  }
  return samples;
}

RegisteredObject registered(const std::vector<TrainingSample>& samples) {
  return registerViews(samples, {}).objects.at(0);
}

TEST(KnownMotionTest, TiesAllViewsOfAMug) {
  const TableView mug("mug");
  const RegisteredObject object = registered(mugWithMotion(mug, 0.3));
  EXPECT_EQ(object.tied(), std::size_t(views));
  const auto [shift, angle] = mug.spread(object, directions());
  EXPECT_LT(shift, 0.003);
  EXPECT_LT(angle, 0.052);
}

/// Somebody turns the object before a camera that stands still: that it did not move says nothing.
TEST(KnownMotionTest, OfACameraThatStandsStillSaysNothing) {
  const TableView duck("duck");
  std::vector<TrainingSample> samples = duck.captureAround(views);
  const RegisteredObject without = registered(samples);
  for (TrainingSample& sample : samples) sample.T_fixed_source = duck.T_table_camera(0);
  const RegisteredObject with = registered(samples);
  ASSERT_GE(without.tied(), std::size_t(views - 1));
  ASSERT_EQ(with.tied(), without.tied());
  for (std::size_t v = 0; v < with.views.size(); ++v) {
    if (!without.views[v].T_model_view) continue;
    EXPECT_TRUE(with.views[v].T_model_view->isApprox(*without.views[v].T_model_view));
  }
}

}  // namespace
}  // namespace sks
