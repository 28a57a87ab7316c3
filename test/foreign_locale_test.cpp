// SPDX-License-Identifier: BSD-3-Clause
// The command line in a program whose locale has a decimal comma: the same files as everywhere.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include "foreign_locale.hpp"

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.hpp"
#include "temporary_folder.hpp"
#include "tools/application.hpp"

namespace sks::test {
namespace {

/// Runs the command line in this process.
void runHere(std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  testing::internal::CaptureStdout();
  EXPECT_NO_THROW(tools::makeApplication()->parse(std::move(arguments)));
  const std::string output = testing::internal::GetCapturedStdout();
  EXPECT_FALSE(std::regex_search(output, std::regex("[0-9],[0-9]"))) << output;
}

/// Simulates, trains and evaluates; the text of all that is written, but for times and memory.
std::vector<std::string> filesOf(const std::string& set) {
  const TemporaryFolder folder;
  const std::string data_set = folder.path(set + "/dataset.yaml"), codebook = folder.path("a.sks"),
                    results = folder.path("results.json");
  runHere({"simulate", "--output", folder.path(set), "--mesh", "mug=builtin:mug", "--scenes", "1", "--objects", "1",
           "--distractors", "1"});
  runHere({"train", "--dataset", data_set, "--output", codebook, "--views", "12", "--set", "keypoints.discard=0.25"});
  runHere({"evaluate", "--dataset", data_set, "--codebook", codebook, "--json", results});
  const std::string text = readTextFile(results);
  EXPECT_FALSE(std::regex_search(text, std::regex("[0-9],[0-9]"))) << text;
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_EQ(json["true_positives"], 1);
  return {readTextFile(data_set), readTextFile(folder.path(set + "/scenes/scene000.pcd")),
          readTextFile(codebook), json["per_scene"][0]["detections"].dump(),
          json["pose"].dump(),    json["f1"].dump()};
}

}  // namespace

TEST(ForeignLocaleCommands, WriteTheSameFiles) {
  const std::vector<std::string> usual = filesOf("set");
  std::vector<std::string> foreign;
  {
    const CommaLocale locale;
    foreign = filesOf("set");
  }
  EXPECT_FALSE(std::regex_search(foreign.at(0), std::regex("[0-9],[0-9]"))) << foreign[0];
  ASSERT_EQ(foreign.size(), usual.size());
  for (std::size_t i = 0; i < usual.size(); ++i) EXPECT_TRUE(foreign[i] == usual[i]) << i << ": " << foreign[i];
}

}  // namespace sks::test

#endif
