// SPDX-License-Identifier: BSD-3-Clause
// The life of a camera that comes and goes, with a device made up for it.
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "ros/camera/camera.hpp"

namespace sks_detector {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// What the made-up devices do at the moment.
struct World {
  std::atomic<bool> plugged{true};
  std::atomic<bool> gives_frames{true};
  std::atomic<bool> ends{false};
  std::atomic<bool> running{false};
  std::atomic<int> opened{0};
};

class FakeDevice : public CameraDevice {
public:
  explicit FakeDevice(World& world) : world_(world) {
    description_.name = "fake";
    description_.uri = "fake://1";
    description_.depth_mode = {4, 3, 100};
    description_.remarks = {"it is not real"};
  }
  ~FakeDevice() override { world_.running = false; }

  const DeviceDescription& description() const override { return description_; }
  void start() override { world_.running = true; }
  void stop() override { world_.running = false; }
  bool connected() const override { return world_.plugged; }
  ReadResult read(CameraFrame&, std::chrono::milliseconds) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (!world_.plugged) throw sks::Error(sks::ErrorCode::bad_data, "cable pulled");
    if (world_.ends) return ReadResult::recording_ended;
    return world_.gives_frames ? ReadResult::frame : ReadResult::nothing_yet;
  }

private:
  World& world_;
  DeviceDescription description_;
};

class CameraTest : public ::testing::Test {
protected:
  CameraTest() {
    settings_.frame_timeout = 0.2;
    settings_.retry_delay = 0.01;
    settings_.max_retry_delay = 0.05;
  }

  void openCamera() {
    const auto open = [this]() -> std::unique_ptr<CameraDevice> {
      if (!world_.plugged) throw sks::Error(sks::ErrorCode::bad_data, "nothing connected");
      ++world_.opened;
      return std::make_unique<FakeDevice>(world_);
    };
    const auto on_event = [this](bool, const std::string& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      events_.push_back(message);
    };
    camera_ = std::make_unique<Camera>(
        settings_, open, [this](const CameraFrame&) { ++frames_; }, on_event);
  }

  /// Waits for something to become true; not for a time.
  template <typename Condition>
  static bool eventually(Condition condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  }
  bool reaches(CameraState state) {
    return eventually([&] { return camera_->status().state == state; });
  }
  bool getsFrames() {
    const int before = frames_;
    return eventually([&] { return frames_ > before + 2; });
  }
  std::vector<std::string> events() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return events_;
  }

  World world_;
  CameraSettings settings_;
  std::atomic<int> frames_{0};
  std::mutex mutex_;
  std::vector<std::string> events_;
  std::unique_ptr<Camera> camera_;
};

TEST_F(CameraTest, RunsOnlyWhileItIsWanted) {
  openCamera();
  ASSERT_TRUE(reaches(CameraState::idle));
  EXPECT_FALSE(world_.running);
  camera_->setWanted(true);
  EXPECT_TRUE(getsFrames());
  camera_->setWanted(false);
  ASSERT_TRUE(reaches(CameraState::idle));
  EXPECT_FALSE(world_.running);
  EXPECT_EQ(world_.opened, 1);
  EXPECT_THAT(events(),
              ElementsAre("Camera: fake (fake://1), depth 4x3 at 100 Hz, no colour", "Camera: it is not real"));
}

TEST_F(CameraTest, ComesBackAndSaysSoOnce) {
  openCamera();
  camera_->setWanted(true);
  ASSERT_TRUE(getsFrames());
  world_.plugged = false;
  ASSERT_TRUE(reaches(CameraState::connecting));
  ASSERT_TRUE(eventually([&] { return camera_->status().error == "nothing connected"; }));
  world_.plugged = true;
  EXPECT_TRUE(getsFrames());
  EXPECT_EQ(camera_->status().reconnects, 1U);
  EXPECT_EQ(camera_->status().error, "");
  EXPECT_THAT(events(), ElementsAre(HasSubstr("fake"), HasSubstr("not real"), HasSubstr("is gone: cable pulled"),
                                    HasSubstr("nothing connected"), HasSubstr("is back")));
}

TEST_F(CameraTest, NoticesWhileIdleThatTheDeviceIsGone) {
  openCamera();
  ASSERT_TRUE(reaches(CameraState::idle));
  world_.plugged = false;
  EXPECT_TRUE(reaches(CameraState::connecting));
  world_.plugged = true;
  EXPECT_TRUE(reaches(CameraState::idle));
}

TEST_F(CameraTest, TakesSilenceForLoss) {
  openCamera();
  camera_->setWanted(true);
  ASSERT_TRUE(getsFrames());
  world_.gives_frames = false;
  ASSERT_TRUE(eventually([&] { return world_.opened > 1; }));
  world_.gives_frames = true;
  EXPECT_TRUE(getsFrames());
  EXPECT_THAT(events()[2], HasSubstr("no frame for 0.2 s (~frame_timeout)"));
}

TEST_F(CameraTest, WaitsForADeviceThatIsNotThereYet) {
  world_.plugged = false;
  openCamera();
  ASSERT_TRUE(eventually([&] { return !camera_->status().error.empty(); }));
  world_.plugged = true;
  ASSERT_TRUE(reaches(CameraState::idle));
  EXPECT_EQ(camera_->status().reconnects, 0U);
}

TEST_F(CameraTest, StopsAtTheEndOfARecording) {
  openCamera();
  camera_->setWanted(true);
  ASSERT_TRUE(getsFrames());
  world_.ends = true;
  ASSERT_TRUE(reaches(CameraState::ended));
  EXPECT_FALSE(world_.running);
  EXPECT_EQ(events().back(), "Camera: the recording has ended");
}

TEST_F(CameraTest, EndsAtOnceWhileItWaits) {
  settings_.retry_delay = settings_.max_retry_delay = 1000;
  world_.plugged = false;
  openCamera();
  ASSERT_TRUE(eventually([&] { return !camera_->status().error.empty(); }));
  const auto start = std::chrono::steady_clock::now();
  camera_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace sks_detector
