// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include <sks_detector/settings_file.hpp>

#include "io/codebook_layout.hpp"
#include "io/crc32c.hpp"

namespace sks::test {

/// Puts right checksums over a changed codebook file, so that what lies behind them is tested.
inline std::string sealed(std::string content) {
  CodebookHeader header;
  std::memcpy(&header, content.data(), sizeof(header));
  header.payload_checksum = crc32c(content.data() + sizeof(header), content.size() - sizeof(header));
  header.header_checksum = header.ownChecksum();
  return content.replace(0, sizeof(header), reinterpret_cast<const char*>(&header), sizeof(header));
}

/// The file as the first version of the format: its descriptors are floats.
inline std::string ofFirstVersion(std::string content, const DescriptorMatrix& descriptors) {
  CodebookHeader header;
  std::memcpy(&header, content.data(), sizeof(header));
  header.version = 1;
  header.descriptors_size = descriptors.rows() * descriptors.cols() * sizeof(float);
  content.resize(header.descriptors_offset);
  content.append(reinterpret_cast<const char*>(descriptors.data()), header.descriptors_size);
  header.file_size = content.size();
  return sealed(content.replace(0, sizeof(header), reinterpret_cast<const char*>(&header), sizeof(header)));
}

/// The file as it was written before settings moved.
/// @param settings that it holds
/// @param candidates that it then holds; 0 for hypotheses from the Hough space
inline std::string withOldSettings(std::string content, const Settings& settings, int candidates) {
  const std::string yaml = settingsToYaml(settings);
  std::string old = yaml;
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = old.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    old.replace(at, from.size(), to);
  };
  const std::string ambiguity = "  ambiguity: " + getSetting(settings, "matching.ambiguity") + "\n";
  const std::string planes = "  skip_planes: " + getSetting(settings, "keypoints.skip_planes") + "\n";
  replace("matching:\n" + ambiguity + "  background: " + getSetting(settings, "matching.background") + "\n", "");
  replace(planes, "");
  replace("  hypotheses: verified\n", "");
  replace("  candidates: " + std::to_string(settings.verification.candidates) + "\n",
          "  candidates: " + std::to_string(candidates) + "\n" + ambiguity + planes);
  const std::size_t at = content.find(yaml);
  EXPECT_NE(at, std::string::npos) << yaml;
  EXPECT_LE(old.size(), yaml.size());
  old.resize(yaml.size(), '\n');
  return sealed(content.replace(at, yaml.size(), old));
}

}  // namespace sks::test
