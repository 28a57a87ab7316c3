// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/clusters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Clusters, AreWhatStepsConnectLargestFirst) {
  const std::vector<Eigen::Vector3f> points{{0, 0, 1},         {0.1f, 0, 1},  {0, 0.015f, 1},
                                            {0.1f, 0, 1.015f}, {0, 0.03f, 1}, {5, 5, 5}};
  EXPECT_THAT(findClusters(points, 0.02), ElementsAre(ElementsAre(0, 2, 4), ElementsAre(1, 3), ElementsAre(5)));
  EXPECT_THAT(findClusters({}, 0.02), IsEmpty());
}

TEST(Clusters, HoldEachPointOnceAndLieApart) {
  const std::vector<Eigen::Vector3f> points = test::randomCloud(400, 0.2f, 7).points;
  const double gap = 0.02;
  const std::vector<Indices> clusters = findClusters(points, gap);
  std::vector<int> cluster_of(points.size(), -1);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const std::uint32_t i : clusters[c]) {
      EXPECT_EQ(cluster_of[i], -1);
      cluster_of[i] = int(c);
    }
  }
  EXPECT_GT(clusters.size(), 3u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GE(cluster_of[i], 0);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_TRUE(cluster_of[i] == cluster_of[k] || (points[i] - points[k]).norm() > gap) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace sks
