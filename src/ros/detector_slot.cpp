// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detector_slot.hpp"

#include <cstdio>

#include <ros/console.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/thresholds.hpp>

namespace sks_detector {
namespace {

void warnOfThresholds(const sks::Detector& detector) {
  for (const std::string& warning :
       sks::thresholdWarnings(detector.settings().detection, detector.codebook().objects)) {
    ROS_WARN_STREAM(warning);
  }
}

}  // namespace

sks::Settings withBound(sks::Settings settings, const sks::Settings& bound) {
  for (const sks::SettingInfo& info : sks::settingInfos()) {
    if (info.binding == sks::Binding::codebook) sks::setSetting(settings, info.key, sks::getSetting(bound, info.key));
  }
  return settings;
}

std::string nameWithChecksum(const sks::Codebook& codebook) {
  char checksum[16];
  std::snprintf(checksum, sizeof(checksum), "%08x", sks::codebookChecksum(codebook));
  return codebook.name + " (" + checksum + ")";
}

DetectorSlot::DetectorSlot(const sks::Settings& settings) : wanted_(settings) {
  sks::validate(settings);
}

std::shared_ptr<const sks::Detector> DetectorSlot::detector() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return detector_;
}

sks::Settings DetectorSlot::settings() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return detector_ ? detector_->settings() : wanted_;
}

sks::Settings DetectorSlot::trainingSettings() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_;
}

std::string DetectorSlot::codebookFile() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return codebook_file_;
}

std::string DetectorSlot::codebookName() const {
  const auto used = detector();
  return used ? nameWithChecksum(used->codebook()) : "";
}

void DetectorSlot::setCodebook(const std::shared_ptr<const sks::Codebook>& codebook, const std::string& file) {
  const std::lock_guard<std::mutex> building(building_);
  std::shared_ptr<const sks::Detector> built;
  if (codebook) {
    built = std::make_shared<sks::Detector>(codebook, withBound(trainingSettings(), codebook->settings));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (built) {  // settings may have changed meanwhile
    built = std::make_shared<sks::Detector>(built->withSettings(withBound(wanted_, codebook->settings)));
    warnOfThresholds(*built);
  }
  detector_.swap(built);  // the old one dies after the lock
  codebook_file_ = codebook ? file : "";
}

void DetectorSlot::setCodebookFile(const sks::Codebook& codebook, const std::string& file) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (detector_ && &detector_->codebook() == &codebook) codebook_file_ = file;
}

void DetectorSlot::setSettings(const sks::Settings& settings) {
  sks::validate(settings);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!detector_) {
    wanted_ = settings;
    return;
  }
  detector_ = std::make_shared<sks::Detector>(detector_->withSettings(settings));
  warnOfThresholds(*detector_);
  wanted_ = withBound(settings, wanted_);
}

}  // namespace sks_detector
