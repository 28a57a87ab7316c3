// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include "tools/cluster/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace sks::tools {
namespace {

using test::errorOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

const std::string binary("a\0\n\xff", 4);

class JournalTest : public ::testing::Test {
protected:
  void SetUp() override {
    Journal journal(path_, "work");
    journal.add(3, binary);
    journal.add(0, "");
  }

  test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("a.journal");
};

TEST_F(JournalTest, KnowsWhatWasAdded) {
  EXPECT_THAT(Journal(path_, "work").known(), ElementsAre(Pair(0u, ""), Pair(3u, binary)));
}

TEST_F(JournalTest, CutsOffWhatIsNotWhole) {
  const std::string whole = readTextFile(path_);
  for (const std::string& rest : {std::string("1"), std::string("00000000 1 aa\n"), std::string("\n\n")}) {
    test::writeFile(path_, whole + rest);
    EXPECT_THAT(Journal(path_, "work").known(), ElementsAre(Pair(0u, ""), Pair(3u, binary)));
    EXPECT_EQ(readTextFile(path_), whole);
  }
  test::writeFile(path_, whole.substr(0, whole.size() - 1));
  EXPECT_THAT(Journal(path_, "work").known(), ElementsAre(Pair(3u, binary)));
}

TEST_F(JournalTest, RefusesOtherWorkAndOtherFiles) {
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { Journal(path_, "other"); }), HasSubstr("of another run"));
  test::writeFile(path_, "my notes\n");
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { Journal(path_, "work"); }), HasSubstr("a.journal"));
  EXPECT_EQ(readTextFile(path_), "my notes\n");
}

TEST_F(JournalTest, BelongsToOneRunAtATime) {
  const Journal first(path_, "work");
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { Journal(path_, "work"); }), HasSubstr("another run"));
}

TEST_F(JournalTest, IsGoneAfterTheWork) {
  Journal(path_, "work").remove();
  EXPECT_EQ(folder_.fileCount(), 0u);
}

TEST_F(JournalTest, SparesTheWorkThatIsKnown) {
  Journal journal(path_, "work");
  JournaledShare share(nullptr, &journal);
  std::vector<std::size_t> worked, taken;
  share.deal(
      5,
      [&](std::size_t i) {
        worked.push_back(i);
        return std::to_string(i);
      },
      [&](std::size_t i, const std::string& result) {
        taken.push_back(i);
        EXPECT_EQ(result, i == 3 ? binary : i == 0 ? "" : std::to_string(i));
      },
      [](std::size_t) {});
  EXPECT_THAT(worked, ElementsAre(1, 2, 4));
  EXPECT_THAT(taken, ElementsAre(0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace sks::tools

#endif
