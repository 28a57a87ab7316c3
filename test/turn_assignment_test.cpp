// SPDX-License-Identifier: BSD-3-Clause
// The turns of views that agree best, from what pairs of them say; and when another turn counts as refuted.
#include "core/registration/turn_assignment.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/registration/turn_ambiguity.hpp"

namespace sks {
namespace {

constexpr std::size_t half = pair_turns / 2;

/// Pairs of views with known turns: each says most for the right difference.
class Pairs {
public:
  explicit Pairs(std::vector<std::size_t> turns) : turns_(std::move(turns)) {
    for (std::size_t a = 0; a < turns_.size(); ++a) {
      for (std::size_t b = a + 1; b < turns_.size(); ++b) {
        UprightPair pair;
        pair.a = a;
        pair.b = b;
        pairs.push_back(pair);
        say(a, b, 0, 10);
      }
    }
  }

  /// What a pair says for a turn beside the right one.
  void say(std::size_t a, std::size_t b, std::size_t beside, double gain) {
    for (UprightPair& pair : pairs) {
      if (pair.a == a && pair.b == b)
        pair.at_turn[(turns_[a] + pair_turns - turns_[b] + beside) % pair_turns].gain = gain;
    }
  }

  void expectRight(const std::vector<std::size_t>& found) const {
    ASSERT_EQ(found.size(), turns_.size());
    for (std::size_t v = 1; v < found.size(); ++v) {
      EXPECT_EQ((found[v] + pair_turns - found[0]) % pair_turns, (turns_[v] + pair_turns - turns_[0]) % pair_turns)
          << v;
    }
  }

  std::vector<UprightPair> pairs;

private:
  std::vector<std::size_t> turns_;
};

TEST(TurnAssignment, FindsTurnsThatAllPairsTell) {
  const Pairs pairs({0, 7, 70, 33, 50});
  pairs.expectRight(assignedTurns(5, pairs.pairs, 3).at(0));
}

TEST(TurnAssignment, MostPairsOutweighThoseThatPreferHalfATurn) {
  Pairs pairs({0, 12, 24, 36, 48, 60});
  for (std::size_t v = 0; v + 1 < 6; ++v) pairs.say(v, v + 1, half, 15);
  pairs.expectRight(assignedTurns(6, pairs.pairs, 3).at(0));
}

TEST(TurnAssignment, TurnsAGroupThatHoldsTogether) {
  Pairs pairs({0, 5, 10, 20, 25, 30});
  // Two groups of three; single views would leave their own group, and one strong pair begins with the wrong turn.
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a + 1; b < 3; ++b) {
      pairs.say(a, b, 0, 100);
      pairs.say(a + 3, b + 3, 0, 100);
    }
  }
  pairs.say(0, 3, half, 150);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 3; b < 6; ++b) {
      if (a != 0 || b != 3) pairs.say(a, b, 0, 30);
    }
  }
  pairs.expectRight(assignedTurns(6, pairs.pairs, 3).at(0));
}

TEST(TurnAssignment, GivesOthersThatComeNear) {
  Pairs pairs({0, 12, 24, 36});
  for (std::size_t v = 0; v < 3; ++v) pairs.say(v, 3, half, 9);  // the last could as well be turned
  const std::vector<ViewTurns> found = assignedTurns(4, pairs.pairs, 3);
  ASSERT_EQ(found.size(), 1u) << "from each pair the best is found";
  pairs.expectRight(found[0]);
  EXPECT_EQ(assignedTurns(1, {}, 3), std::vector<ViewTurns>{{0}});
}

OtherTurn otherTurn(const std::vector<double>& losses) {
  OtherTurn other;
  for (const double loss : losses) {
    other.loss += loss;
    other.shape_loss += loss;
    other.squares += loss * loss;
    other.largest = std::max(other.largest, loss);
    ++other.pairs;
  }
  return other;
}

TEST(OtherTurn, IsRefutedByTwoPairsAndNotByOne) {
  EXPECT_TRUE(otherTurn({60, 60, 0, 0, 0}).isRefuted());
  EXPECT_FALSE(otherTurn({400, 5, 5, 0, 0}).isRefuted());
  EXPECT_FALSE(otherTurn({400, 60, -80, 10, -100}).isRefuted()) << "most comes from one pair, others are for it";
  EXPECT_FALSE(otherTurn({10, 10, 10, 10, 10}).isRefuted()) << "too little";
  EXPECT_TRUE(otherTurn({60, 50}).isRefuted()) << "three views have two pairs";
  EXPECT_FALSE(otherTurn({300, -20}).isRefuted());
  EXPECT_FALSE(otherTurn({-50, -50, 10}).isRefuted());
}

TEST(OtherTurn, IsNotRefutedByPrintsAlone) {
  OtherTurn other = otherTurn({60, 60, 60});
  other.shape_loss = 5;
  EXPECT_FALSE(other.isRefuted());
}

TEST(OtherTurn, OfAFewDegreesIsTheSame) {
  OtherTurn other;
  other.motion = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(other.isOther());
  other.motion = Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(other.isOther());
}

}  // namespace
}  // namespace sks
