// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_coverage.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace sks {
namespace {

/// Tied views from these directions [degrees].
RegisteredObject seenFrom(const std::vector<double>& directions) {
  RegisteredObject object;
  object.model.box = Eigen::AlignedBox3f(Eigen::Vector3f(-0.1f, -0.1f, 0), Eigen::Vector3f(0.1f, 0.1f, 0.1f));
  for (const double degrees : directions) {
    RegisteredView view;
    view.T_model_view = Eigen::Isometry3d::Identity();
    const double turn = degrees * EIGEN_PI / 180;
    view.sensor = Eigen::Vector3d(0.6 * std::cos(turn), 0.6 * std::sin(turn), 0.4);
    object.views.push_back(view);
  }
  object.views.emplace_back();  // one that was not tied
  return object;
}

TEST(ViewCoverage, NamesWhatIsMissing) {
  const ViewCoverage one = coverageOf(seenFrom({0}));
  EXPECT_NEAR(one.share, 7 / 36.0, 1e-9);
  EXPECT_EQ(one.missing, "40 to 320 degrees");
  const ViewCoverage three = coverageOf(seenFrom({0, 60, 180}));
  EXPECT_EQ(three.missing, "100 to 140 degrees, 220 to 320 degrees");
}

TEST(ViewCoverage, IsWholeAllAround) {
  const ViewCoverage all = coverageOf(seenFrom({5, 55, 105, 155, 205, 255, 305}));
  EXPECT_NEAR(all.share, 1, 1e-9);
  EXPECT_TRUE(all.missing.empty());
}

TEST(ViewCoverage, IsNothingWithoutTiedViews) {
  const ViewCoverage none = coverageOf(seenFrom({}));
  EXPECT_EQ(none.share, 0);
  EXPECT_EQ(none.missing, "all around");
}

}  // namespace
}  // namespace sks
