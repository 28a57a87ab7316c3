// SPDX-License-Identifier: BSD-3-Clause
// Small YAML files that are made to take for ever, or all memory: each is refused, or read, at once.
#include <chrono>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include <sks_detector/error.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/settings_file.hpp>

#include "error_of.hpp"
#include "io/dataset.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

std::string times(int count, const std::string& text) {
  std::string all;
  all.reserve(text.size() * std::size_t(count));
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

/// Lists of aliases of lists of aliases: `width` to the power of `levels` entries in a few lines.
std::string laughs(int levels, int width, const std::string& first_key = "") {
  std::string text = first_key + "l0: &l0 [" + times(width, "x, ") + "x]\n";
  for (int level = 1; level <= levels; ++level) {
    const std::string name = "l" + std::to_string(level), inner = "*l" + std::to_string(level - 1);
    text += name + ": &" + name + " [" + times(width, inner + ", ") + inner + "]\n";
  }
  return text;
}

std::vector<std::string> bombs() {
  const std::string head = "name: x\nunits: m\n", last = "*l9";
  return {
      laughs(9, 9),
      head + laughs(9, 9),
      head + laughs(9, 9) + "training: " + last + "\n",
      "keypoints:\n" + laughs(9, 9, "  "),
      laughs(9, 9) + "keypoints: " + last + "\n",
      "name: " + laughs(9, 9, "{ ") + "}\n",
      times(100000, "["),
      times(100000, "{a: "),
      times(100000, "- "),
      times(100000, "? "),
      times(300, "[") + times(300, "]") + "\n",
      times(100000, "---\n"),
      "a: 1\n---\n" + times(50000, "b: 2\n"),
      "&a [*a, *a]\n",
      "a: &a {<<: *a}\n",
      "a: &a {b: 1}\nc: {<<: [" + times(20000, "*a, ") + "*a]}\n",
      "a: \"" + times(200000, "\\n"),
      "a: |\n" + times(100000, "  x\n"),
      "a: |9\n" + times(100000, " \n"),
      times(100000, "# a comment\n") + "a: 1\n",
      "a: " + times(300000, "9") + "\n",
      "threads: " + times(100000, "0") + "\n",
      times(20000, "a: 1\n"),
      times(50000, "!!str "),
      times(100000, "'"),
      times(50000, "{}: "),
      std::string(100000, '\0'),
      times(100000, "\t"),
      times(100000, "\r"),
      times(30000, "%TAG ! x\n"),
      head + "training: [" + times(30000, "{}, ") + "]\n",
  };
}

/// Scenes that share one list of objects.
std::string sharedObjects(int scenes, int objects) {
  std::string text = "name: x\nunits: m\nmax_distance: 0.05\nscenes:\n  - {name: s, cloud: a.pcd, objects: &o [" +
                     times(objects, "{object: a, position: [0, 0, 1]},") + "]}\n";
  for (int i = 0; i < scenes; ++i) text += "  - {name: s" + std::to_string(i) + ", cloud: a.pcd, objects: *o}\n";
  return text;
}

}  // namespace

TEST(YamlBombs, AliasesThatMultiplyAreRefused) {
  const test::TemporaryFolder folder;
  test::writeFile(folder.path("a.pcd"), "");
  const DataSet few = parseDataSet(sharedObjects(100, 20), folder.path("few.yaml"));
  ASSERT_EQ(few.scenes.size(), 101u);
  EXPECT_EQ(few.scenes.back().objects.size(), 20u);
  const auto start = std::chrono::steady_clock::now();
  const std::string refusal =
      test::errorOf(ErrorCode::bad_file, [] { parseDataSet(sharedObjects(5000, 5000), "bomb.yaml"); });
  EXPECT_EQ(refusal.rfind("bomb.yaml:30: ", 0), 0u) << refusal;  // the 25th alias
  EXPECT_NE(refusal.find("the aliases (*name) up to here stand for more than 1000000 values"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(YamlBombs, AreReadOrRefusedAtOnce) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> texts = bombs();
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    try {
      Settings settings;
      parseSettings(texts[i], "bomb", settings);
    } catch (const Error&) {
    }
    try {
      test::writeFile(folder.path("bomb.yaml"), texts[i]);
      loadDataSet(folder.path("bomb.yaml"));
      ADD_FAILURE() << "bomb " << i << " is no data set";
    } catch (const Error& error) {
      EXPECT_LT(std::string(error.what()).size(), 10000u) << "bomb " << i;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << "bomb " << i;
  }
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 500 * 1024) << "kB";
}

}  // namespace sks
