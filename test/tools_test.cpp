// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <cmath>

#include <gtest/gtest.h>

#include "tools/progress_bar.hpp"
#include "tools/table.hpp"

namespace sks::tools {

TEST(Table, AlignsColumns) {
  Table table({"<object", "score"});
  table.add({"mario", "0.5"});
  table.add({"größe", "12.25"});  // as wide as its characters, not its bytes
  EXPECT_EQ(table.text(),
            "object  score\n"
            "mario     0.5\n"
            "größe   12.25\n");
}

TEST(Table, FixedDecimals) {
  EXPECT_EQ(fixed(1.23456, 2), "1.23");
  EXPECT_EQ(fixed(-0.5, 0), "-0");
  EXPECT_EQ(fixed(std::nan(""), 3), "-");
}

TEST(ProgressLine, ShowsRateAndTimeLeft) {
  EXPECT_EQ(progressLine({"training", "mario.pcd", 12, 24}, 4, 100),
            "training  12/24 [##########----------] 3/s, 4 s left  mario.pcd");
  EXPECT_EQ(progressLine({"training", "a", 0, 24}, 0, 100), "training  0/24 [--------------------]  a");
  EXPECT_EQ(progressLine({"training", "", 24, 24}, 8, 100), "training  24/24 [####################] 3/s  ");
  EXPECT_EQ(progressLine({"reading", "b", 5, 0}, 2, 100), "reading  5 2.5/s  b");
  EXPECT_EQ(progressLine({"training", "a", 1, 1000}, 10, 100),
            "training  1/1000 [--------------------] 0.1/s, 2.8 h left  a");
  EXPECT_EQ(progressLine({"training", "a", 1, 100}, 10, 100),
            "training  1/100 [--------------------] 0.1/s, 16 min left  a");
  EXPECT_EQ(progressLine({"training", "mario.pcd", 12, 24}, 4, 10), "training  ");
}

}  // namespace sks::tools

#endif
