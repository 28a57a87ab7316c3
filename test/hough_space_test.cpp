// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"

namespace sks::baselines {

TEST(HoughSpace, OfVotesThatLieTooFarApartIsRefused) {
  const Eigen::Vector3d near(0.1, 0.1, 1), far(2000, 2000, 1000);
  for (const double bin_size : {0.001, 0.03}) {
    EXPECT_THAT(test::errorOf(ErrorCode::bad_data,
                              [&] {
                                HoughSpace({near, far}, bin_size);
                              }),
                testing::AllOf(testing::HasSubstr("too many bins"), testing::HasSubstr("sanitize.max_range")));
  }
}

TEST(HoughSpace, OfVotesWithinAFewMetresIsMade) {
  HoughSpace space({{-2, -2, 0}, {2, 2, 4}, {0.5, 0.5, 1}}, 0.03);
  space.vote({0.5, 0.5, 1}, 1, 7);
  EXPECT_THAT(space.maxima(0.5), testing::ElementsAre(testing::ElementsAre(7)));
  EXPECT_THAT(HoughSpace({{0, 0, 1}, {0, 0, 1}}, 0.03).maxima(0.5), testing::IsEmpty());
}

}  // namespace sks::baselines
