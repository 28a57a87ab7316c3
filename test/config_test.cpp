// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include <sks_detector/settings_file.hpp>

namespace {

sks::Settings preset(const std::string& name) {
  sks::Settings settings;
  std::vector<std::string> warnings;
  sks::loadSettings(std::string(SKS_SOURCE_DIR) + "/config/" + name, settings, &warnings);
  for (const std::string& warning : warnings) ADD_FAILURE() << warning;
  return settings;
}

}  // namespace

TEST(Config, EveryShippedFileLoadsAndIsValid) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(SKS_SOURCE_DIR) + "/config")) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    EXPECT_NO_THROW(sks::validate(preset(entry.path().filename().string()))) << entry.path();
  }
  EXPECT_GE(files, 3);
}

TEST(Config, DefaultPresetIsTheBuiltInDefault) {
  EXPECT_EQ(sks::settingsToYaml(preset("default.yaml")), sks::settingsToYaml(sks::Settings()));
}

TEST(Config, PaperPresetStatesWhatThePaperStates) {
  const sks::Settings paper = preset("paper.yaml");
  EXPECT_EQ(paper.keypoints.grid_size, 0.02);
  EXPECT_EQ(paper.keypoints.selection, sks::SelectionRule::rank);
  EXPECT_EQ(paper.keypoints.discard, 0.5);
  EXPECT_EQ(paper.descriptor.radius, 0.05);
  EXPECT_EQ(paper.surface.resolution, 0);
  EXPECT_EQ(paper.detection.hypotheses, sks::Hypotheses::hough);
}
