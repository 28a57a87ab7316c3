// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_candidates.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace sks {
namespace {

/// Votes for so many objects, and others without any.
std::vector<std::vector<Vote>> votesFor(std::size_t objects) {
  std::vector<std::vector<Vote>> spaces(objects + 100);
  for (std::size_t i = 0; i < objects; ++i) spaces[i].resize(1);
  return spaces;
}

TEST(PoseCandidates, ManyObjectsShareTheTotal) {
  VerificationSettings settings;
  settings.candidates = 120;
  settings.total_candidates = 960;
  EXPECT_EQ(candidatesOfEach(votesFor(0), settings), 120);
  EXPECT_EQ(candidatesOfEach(votesFor(8), settings), 120);
  EXPECT_EQ(candidatesOfEach(votesFor(21), settings), 45);
  EXPECT_EQ(candidatesOfEach(votesFor(32), settings), 30);
  EXPECT_EQ(candidatesOfEach(votesFor(1000), settings), 30) << "a quarter";
}

TEST(PoseCandidates, AtLeastOneOfEachIsLookedAt) {
  VerificationSettings settings;
  settings.candidates = 3;
  settings.total_candidates = 1;
  EXPECT_EQ(candidatesOfEach(votesFor(1000), settings), 1);
  settings.candidates = 1;
  EXPECT_EQ(candidatesOfEach(votesFor(0), settings), 1);
}

}  // namespace
}  // namespace sks
