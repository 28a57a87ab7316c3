// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/background_search.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "tracker_scene.hpp"

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace sks {
namespace {

using ::testing::SizeIs;

class BackgroundSearchTest : public TrackerTest {
protected:
  BackgroundSearchTest() { look(0); }

  std::shared_ptr<const Cloud> cloud() { return std::make_shared<const Cloud>(see()); }

  std::shared_ptr<const Detector> detector() const { return std::make_shared<const Detector>(detector_); }

  BackgroundSearch search_;
};

TEST_F(BackgroundSearchTest, GivesATrackerWhatTheDetectorFinds) {
  EXPECT_FALSE(search_.started());
  EXPECT_FALSE(search_.finished());
  search_.start(detector(), cloud(), view(), tracker_.occupied());
  EXPECT_TRUE(search_.started());
  for (int i = 0; i < 600 && !search_.finished(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_TRUE(search_.finished());
  search_.giveTo(tracker_);
  EXPECT_FALSE(search_.started());
  EXPECT_FALSE(search_.finished());
  EXPECT_FALSE(tracker_.wantsDetection(stamp_));
  const auto objects = next();
  ASSERT_THAT(objects, SizeIs(2));
  for (const TrackedObject& object : objects) expectRight(object);
}

TEST_F(BackgroundSearchTest, LeavesOutWhatIsOccupied) {
  begin();
  search();
  next();
  ASSERT_THAT(tracker_.occupied(), SizeIs(2));
  Tracker other(detector_);
  search_.start(detector(), cloud(), view(), tracker_.occupied());
  search_.giveTo(other);
  EXPECT_EQ(other.size(), 0u);
}

TEST_F(BackgroundSearchTest, DropsWhatIsNotWantedAnyMore) {
  search_.start(detector(), cloud(), view(), {});
  search_.drop();
  EXPECT_FALSE(search_.started());
  search_.giveTo(tracker_);
  EXPECT_EQ(tracker_.size(), 0u);
  EXPECT_TRUE(tracker_.wantsDetection(stamp_));
}

TEST_F(BackgroundSearchTest, TellsTheErrorOfASearchOnceAndGoesOn) {
  search_.start(detector(), std::make_shared<const Cloud>(), view(), {});
  EXPECT_FALSE(test::errorOf(ErrorCode::bad_data, [&] { search_.giveTo(tracker_); }).empty());
  EXPECT_FALSE(search_.started());
  search_.start(detector(), cloud(), view(), {});
  search_.giveTo(tracker_);
  EXPECT_EQ(tracker_.size(), 2u);
}

#ifdef __linux__
/// The lowest priority of a thread of this process: the highest niceness.
int highestNiceness() {
  int highest = getpriority(PRIO_PROCESS, 0);
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    errno = 0;
    const int niceness = getpriority(PRIO_PROCESS, id_t(std::stoi(task.path().filename())));
    if (errno == 0) highest = std::max(highest, niceness);
  }
  return highest;
}

TEST_F(BackgroundSearchTest, SearchesWithLowPriorityButLeavesThatOfTheCallingThread) {
  const int before = getpriority(PRIO_PROCESS, 0);
  ASSERT_EQ(highestNiceness(), before);
  search_.start(detector(), cloud(), view(), {});
  int highest = before;
  while (highest == before && !search_.finished()) highest = highestNiceness();
  EXPECT_GT(highest, before);
  search_.giveTo(tracker_);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), before);
}
#endif

}  // namespace
}  // namespace sks
