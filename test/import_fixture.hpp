// SPDX-License-Identifier: BSD-3-Clause
// A folder in the format of a public data set, imported by the command line.
#pragma once

#include <filesystem>

#include <gtest/gtest.h>

#include "io/dataset.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks::test {

class ImportTest : public ::testing::Test {
protected:
  /// Writes a file of the download, and the folders that it lies in.
  void write(const std::string& name, const std::string& content) const { writeFile(place(name), content); }
  /// The path of a file of the download; its folders are made.
  std::string place(const std::string& name) const {
    const std::filesystem::path path(folder_.path("download/" + name));
    std::filesystem::create_directories(path.parent_path());
    return path.string();
  }
  std::string output() const { return folder_.path("sets/set.yaml"); }

  CommandRun import(const std::string& format, std::vector<std::string> options = {}) const {
    std::filesystem::create_directories(folder_.path("sets"));
    std::filesystem::create_directories(folder_.path("download"));
    options.insert(options.begin(), {"import", format, folder_.path("download"), "--output", output()});
    return runSks(options);
  }
  /// What was written, after an import without complaints.
  DataSet imported(const std::string& format, const std::vector<std::string>& options = {}) const {
    const CommandRun run = import(format, options);
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    return loadDataSet(output());
  }
  /// What a failing import says; nothing may have been written then.
  std::string refusal(const std::string& format, const std::vector<std::string>& options = {}) const {
    const CommandRun run = import(format, options);
    EXPECT_EQ(run.status, 1) << run.output;
    EXPECT_FALSE(std::filesystem::exists(output()));
    return run.errors;
  }

  TemporaryFolder folder_;
};

/// A box of the given size as an OFF file whose first line is `head`, for example "OFF\n8 6 12".
inline std::string offBox(const std::string& head, double x, double y, double z) {
  std::string text = head + "\n";
  for (int i = 0; i < 8; ++i) {
    text += std::to_string(i & 1 ? x : 0) + " " + std::to_string(i & 2 ? y : 0) + " " + std::to_string(i & 4 ? z : 0) +
            "\n";
  }
  return text + "4 0 1 3 2\n4 4 5 7 6\n4 0 1 5 4\n4 2 3 7 6\n4 0 2 6 4\n4 1 3 7 5\n";
}

/// Points as an ascii PCD file.
inline std::string pcdText(const std::vector<std::vector<double>>& points) {
  const std::string count = std::to_string(points.size());
  std::string text = "# .PCD v.7\nVERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
                     "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA ascii\n";
  for (const auto& p : points) {
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  return text;
}

/// Points, and one triangle of the first three, as an ascii PLY file.
inline std::string plyText(const std::vector<std::vector<double>>& points) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                     "property list uchar int vertex_indices\nend_header\n";
  for (const auto& p : points) {
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  return text + "3 0 1 2\n";
}

}  // namespace sks::test
