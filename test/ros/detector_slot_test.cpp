// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detector_slot.hpp"

#include <atomic>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// One word of one view; its descriptor is full of `value`.
std::shared_ptr<sks::Codebook> codebookOf(const std::string& name, double radius, float value = 1) {
  const auto codebook = std::make_shared<sks::Codebook>();
  codebook->name = name;
  codebook->descriptor_type = sks::DescriptorType::shot;
  codebook->settings.descriptor.type = sks::DescriptorType::shot;
  codebook->settings.descriptor.radius = radius;
  codebook->settings.detection.threshold = 0.9;
  codebook->objects = {"thing"};
  codebook->views.resize(1);
  codebook->words.resize(1);
  codebook->descriptors =
      sks::QuantizedDescriptors(sks::DescriptorMatrix(std::vector<float>(sks::shot_size, value), sks::shot_size));
  codebook->checksum.set(0xabc);
  return codebook;
}

sks::Settings settingsWith(double radius, double threshold) {
  sks::Settings settings;
  settings.descriptor.radius = radius;
  settings.detection.threshold = threshold;
  return settings;
}

TEST(DetectorSlot, IsEmptyAtFirst) {
  const DetectorSlot slot(settingsWith(0.04, 0.3));
  EXPECT_FALSE(slot.detector());
  EXPECT_EQ(slot.codebookName(), "");
  EXPECT_EQ(slot.codebookFile(), "");
  EXPECT_EQ(slot.settings().descriptor.radius, 0.04);
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [] { DetectorSlot(settingsWith(0.001, 0.3)); }),
              HasSubstr("descriptor.radius"));
}

TEST(DetectorSlot, TakesWhatIsBoundFromTheCodebook) {
  DetectorSlot slot(settingsWith(0.04, 0.3));
  slot.setCodebook(codebookOf("toys", 0.06), "/some/toys.sks");
  ASSERT_TRUE(slot.detector());
  EXPECT_EQ(slot.codebookName(), "toys (00000abc)");
  EXPECT_EQ(slot.codebookFile(), "/some/toys.sks");
  EXPECT_EQ(slot.settings().descriptor.radius, 0.06);
  EXPECT_EQ(slot.settings().detection.threshold, 0.3) << "a free one stays the node's";
  EXPECT_EQ(slot.trainingSettings().descriptor.radius, 0.04);

  slot.setCodebook(nullptr, "");
  EXPECT_FALSE(slot.detector());
  EXPECT_EQ(slot.codebookFile(), "");
  EXPECT_EQ(slot.settings().descriptor.radius, 0.04);
}

TEST(DetectorSlot, SwapsSettings) {
  DetectorSlot slot(settingsWith(0.04, 0.3));
  slot.setSettings(settingsWith(0.05, 0.4));
  EXPECT_EQ(slot.trainingSettings().descriptor.radius, 0.05);
  slot.setCodebook(codebookOf("toys", 0.06), "");
  const auto before = slot.detector();
  slot.setSettings(settingsWith(0.06, 0.7));
  EXPECT_EQ(slot.detector()->settings().detection.threshold, 0.7);
  EXPECT_EQ(before->settings().detection.threshold, 0.4) << "a frame under way sees what it began with";
  EXPECT_EQ(&slot.detector()->codebook(), &before->codebook());
  EXPECT_EQ(slot.trainingSettings().detection.threshold, 0.7);
  EXPECT_EQ(slot.trainingSettings().descriptor.radius, 0.05);
}

TEST(DetectorSlot, RefusesBadSettingsAsAWhole) {
  DetectorSlot slot(settingsWith(0.04, 0.3));
  const auto refused = [&](const sks::Settings& settings) {
    return errorOf(ErrorCode::bad_usage, [&] { slot.setSettings(settings); });
  };
  EXPECT_THAT(refused(settingsWith(0.05, 1.5)), HasSubstr("detection.threshold"));
  EXPECT_EQ(slot.settings().descriptor.radius, 0.04);

  slot.setCodebook(codebookOf("toys", 0.06), "");
  sks::Settings crossed = settingsWith(0.06, 0.8);
  crossed.sanitize.min_range = 3;
  crossed.sanitize.max_range = 2;
  EXPECT_THAT(refused(crossed), AllOf(HasSubstr("sanitize.min_range"), HasSubstr("sanitize.max_range")));
  EXPECT_THAT(errorOf(ErrorCode::incompatible, [&] { slot.setSettings(settingsWith(0.07, 0.8)); }),
              AllOf(HasSubstr("'toys' was trained with descriptor.radius = 0.06 (not 0.07)")));
  EXPECT_EQ(slot.settings().detection.threshold, 0.3);
  EXPECT_EQ(slot.trainingSettings().detection.threshold, 0.3);
}

TEST(DetectorSlot, KeepsTheOldCodebookOnFailure) {
  DetectorSlot slot(settingsWith(0.04, 0.3));
  slot.setCodebook(codebookOf("good", 0.06), "good.sks");
  const auto before = slot.detector();
  EXPECT_THROW(slot.setCodebook(codebookOf("bad", 0.06, std::numeric_limits<float>::quiet_NaN()), "bad.sks"),
               sks::Error);
  EXPECT_THROW(slot.setCodebook(codebookOf("worse", 0.001), "worse.sks"), sks::Error);
  EXPECT_EQ(slot.detector(), before);
  EXPECT_EQ(slot.codebookFile(), "good.sks");
}

TEST(DetectorSlot, NotesAFileOnlyOfTheCodebookInUse) {
  DetectorSlot slot{sks::Settings()};
  const auto old = codebookOf("old", 0.06), used = codebookOf("new", 0.06);
  slot.setCodebook(used, "");
  slot.setCodebookFile(*old, "old.sks");
  EXPECT_EQ(slot.codebookFile(), "");
  slot.setCodebookFile(*used, "new.sks");
  EXPECT_EQ(slot.codebookFile(), "new.sks");
}

TEST(DetectorSlot, IsConsistentWhileAllChanges) {
  DetectorSlot slot(settingsWith(0.04, 0.3));
  const auto narrow = codebookOf("narrow", 0.06), wide = codebookOf("wide", 0.08);
  slot.setCodebook(narrow, "narrow");
  std::atomic<bool> done{false};
  std::atomic<int> mixed{0}, seen{0};
  std::thread reader([&] {
    while (!done) {
      const auto detector = slot.detector();
      const double radius = detector->codebook().name == "narrow" ? 0.06 : 0.08;
      mixed += detector->settings().descriptor.radius != radius;
      ++seen;
    }
  });
  std::thread tuner([&] {
    for (int i = 0; i < 300; ++i) {
      sks::Settings settings = slot.settings();
      settings.detection.threshold = i % 2 == 0 ? 0.2 : 0.8;
      try {
        slot.setSettings(settings);
      } catch (const sks::Error&) {
        // the codebook was swapped since
      }
    }
  });
  for (int i = 0; i < 60; ++i) slot.setCodebook(i % 2 == 0 ? wide : narrow, "");
  tuner.join();
  while (seen == 0) std::this_thread::yield();
  done = true;
  reader.join();
  EXPECT_EQ(mixed, 0);
  EXPECT_EQ(slot.codebookName(), "narrow (00000abc)");
  EXPECT_EQ(slot.trainingSettings().descriptor.radius, 0.04);
}

}  // namespace
}  // namespace sks_detector
