// SPDX-License-Identifier: BSD-3-Clause
// What a user meets: exit status, messages, and outputs that are written whole or not at all.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/codebook_file.hpp>
#include <sks_detector/settings_file.hpp>

#include "bumps.hpp"
#include "io/file.hpp"
#include "old_codebook.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::CommandRun;
using test::runSks;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A folder with a data set of one training cloud.
class CommandLine : public ::testing::Test {
protected:
  void SetUp() override {
    writeCloud(path("bumps.pcd"), test::bumps());
    writeDataSet("training:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n");
  }

  std::string path(const std::string& name) const { return folder_.path(name); }
  void writeDataSet(const std::string& entries) const {
    test::writeFile(path("toys.yaml"), "name: toys\nunits: m\nmax_distance: 0.05\n" + entries);
  }

  CommandRun train(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"train", "--dataset", path("toys.yaml"), "--output", path("toys.sks")});
    return runSks(more);
  }
  CommandRun detect(const std::string& cloud, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"detect", "--codebook", path("toys.sks"), path(cloud)});
    return runSks(more);
  }

  /// Checks that a run failed with one line on stderr and nothing on stdout; returns that line.
  static std::string failure(const CommandRun& run, int status = 1) {
    EXPECT_EQ(run.status, status) << run.errors;
    EXPECT_EQ(run.output, "");
    EXPECT_THAT(run.errors, StartsWith("sks: "));
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
    return run.errors;
  }

  test::TemporaryFolder folder_;
};

std::string asciiPcd(const std::vector<std::string>& points) {
  const std::string count = std::to_string(points.size());
  std::string text = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH " + count + "\nHEIGHT 1\nPOINTS " +
                     count + "\nDATA ascii\n";
  for (const std::string& point : points) text += point + "\n";
  return text;
}

}  // namespace

TEST_F(CommandLine, HelpAndVersion) {
  const CommandRun help = runSks({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"train", "detect", "evaluate", "info", "verify", "settings"}) {
    EXPECT_THAT(help.output, HasSubstr(std::string("\n  ") + command + " "));
    const CommandRun each = runSks({command, "--help"});
    EXPECT_EQ(each.status, 0);
    EXPECT_THAT(each.output, HasSubstr(std::string("Usage: sks ") + command));
  }
  const CommandRun version = runSks({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.output, ::testing::MatchesRegex("sks [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(CommandLine, BadUsageHasStatus2) {
  EXPECT_EQ(failure(runSks({}), 2), "sks: A subcommand is required; see --help\n");
  EXPECT_EQ(failure(runSks({"detct"}), 2), "sks: unknown subcommand 'detct': did you mean 'detect'?; see --help\n");
  EXPECT_EQ(failure(runSks({"detect"}), 2), "sks: --codebook is required; see --help\n");
  EXPECT_THAT(failure(runSks({"info", "a.sks", "--bogus"}), 2), HasSubstr("--bogus"));
  EXPECT_EQ(failure(train({"--set", "keypoints.discrad=0.5"}), 2),
            "sks: unknown setting 'keypoints.discrad': did you mean 'keypoints.discard'?\n");
  EXPECT_EQ(failure(train({"--set", "keypoints.discard"}), 2),
            "sks: --set keypoints.discard: expected key=value, e.g. --set keypoints.discard=0.5\n");
  EXPECT_EQ(failure(train({"--set", "keypoints.discard=2"}), 2),
            "sks: keypoints.discard = 2 is out of range: 0 to 0.99\n");
  EXPECT_EQ(failure(train({"--set", "descriptor.radius=0.005"}), 2),
            "sks: surface.normal_radius = 0.01 must be less than descriptor.radius = 0.005\n");
  test::writeFile(path("c.yaml"), "keypoints:\n  discard: half\n");
  EXPECT_EQ(failure(train({"--config", path("c.yaml")}), 2),
            "sks: " + path("c.yaml") + ":2: keypoints.discard = half: expected a number in 0 to 0.99\n");
  EXPECT_EQ(failure(detect("bumps.pcd", {"--scale", "0"}), 2),
            "sks: --scale: '0' is not a positive number; see --help\n");
}

TEST_F(CommandLine, TrainDetectInfoVerify) {
  const CommandRun trained = train({"--name", "my toys"});
  ASSERT_EQ(trained.status, 0) << trained.errors;
  EXPECT_EQ(trained.errors, "");  // no progress bar where there is no terminal
  EXPECT_THAT(trained.output,
              AllOf(HasSubstr("codebook 'my toys', shot"), HasSubstr("\nbumps "), HasSubstr("trained in")));

  const CommandRun info = runSks({"info", path("toys.sks"), "--json", "-"});
  ASSERT_EQ(info.status, 0) << info.errors;
  const json held = json::parse(info.output);
  EXPECT_EQ(held["name"], "my toys");
  EXPECT_EQ(held["objects"].size(), 1u);
  EXPECT_EQ(held["objects"][0]["name"], "bumps");
  EXPECT_EQ(held["descriptor_type"], "shot");
  EXPECT_EQ(held["settings"]["keypoints.grid_size"], 0.02);
  EXPECT_GT(held["codewords"], 20);

  const CommandRun verified = runSks({"verify", path("toys.sks")});
  EXPECT_EQ(verified.status, 0);
  EXPECT_THAT(verified.output, AllOf(HasSubstr("whole, 1 objects, 1 training clouds"),
                                     HasSubstr("checksum " + held["checksum"].get<std::string>())));

  const CommandRun found = detect("bumps.pcd", {"--json", path("found.json"), "--image", path("found.png")});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.output, HasSubstr("\nbumps "));
  const json result = json::parse(readTextFile(path("found.json")));
  EXPECT_EQ(result["codebook"]["checksum"], held["checksum"]);
  ASSERT_EQ(result["clouds"].size(), 1u);
  EXPECT_EQ(result["clouds"][0]["cloud"], path("bumps.pcd"));
  const json& best = result["clouds"][0]["detections"][0];
  EXPECT_EQ(best["object"], "bumps");
  EXPECT_GT(best["score"], 0.5);
  ASSERT_EQ(best["pose"].size(), 16u);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(best["pose"][std::size_t(i)].get<double>(), i % 5 == 0 ? 1 : 0, 0.01) << i;
  EXPECT_EQ(best["box"]["center"], best["position"]);
  EXPECT_EQ(best["box"]["orientation"].size(), 4u);
  EXPECT_NEAR(best["box"]["size"][0].get<double>(), 0.18, 0.01);
  EXPECT_EQ(best["view"], "bumps.pcd");
  EXPECT_THAT(readTextFile(path("found.png")), StartsWith("\x89PNG"));
}

TEST_F(CommandLine, NothingIsSuggestedThatResemblesNothing) {
  EXPECT_EQ(failure(runSks({"banana"}), 2), "sks: unknown subcommand 'banana'; see --help\n");
  EXPECT_EQ(failure(train({"--set", "banana=1"}), 2),
            "sks: unknown setting 'banana'; `sks settings` lists all there are\n");
  EXPECT_EQ(failure(train({"--set", "sanitize.banana=1"}), 2).find("did you mean"), std::string::npos);
}

TEST_F(CommandLine, TextFromOutsideIsShortenedAndCleaned) {
  for (const std::string& text : {std::string("a\n\x1b[31mb"), std::string(100000, 'x'), std::string("caf\xe9")}) {
    for (const CommandRun& run :
         {runSks({text}), runSks({"info", text}), train({"--set", text}), train({"--set", text + "=1"}), detect(text),
          train({"--set", "descriptor.type=" + text}), train({"--name", text}), train({"--mesh", text + "=a.ply"}),
          runSks({"evaluate", "--dataset", path("toys.yaml"), "--method", text})}) {
      EXPECT_LT(failure(run, run.status).size(), 5000u);
      EXPECT_NE(run.status, 0);
      EXPECT_EQ(run.errors.find('\x1b'), std::string::npos) << run.errors;
      EXPECT_EQ(run.errors.find('\xe9'), std::string::npos) << run.errors;
    }
  }
}

TEST_F(CommandLine, CodebooksAreCalledSo) {
  const std::string expected =
      "sks: '" + path("toys.txt") + "' is not called like a codebook; let its name end with .sks\n";
  EXPECT_EQ(failure(runSks({"train", "-d", path("toys.yaml"), "-o", path("toys.txt")}), 2), expected);
  EXPECT_EQ(failure(runSks({"classify", "-d", path("toys.yaml"), "--save-codebook", path("toys.txt")}), 2), expected);
}

TEST_F(CommandLine, MethodsThatCannotEvaluateAreNotOffered) {
  const auto help = [](const std::string& command) { return runSks({command, "--help"}).output; };
  EXPECT_EQ(help("evaluate").find("knopp"), std::string::npos);
  EXPECT_THAT(help("evaluate"), HasSubstr("aldoma"));
  EXPECT_THAT(help("classify"), HasSubstr("knopp"));
  EXPECT_EQ(help("classify").find("aldoma"), std::string::npos);
  const std::string message = failure(runSks({"evaluate", "-d", path("toys.yaml"), "-m", "tombary"}), 2);
  EXPECT_THAT(message, HasSubstr("there is no method 'tombary'; did you mean 'tombari'?"));
}

TEST_F(CommandLine, JsonOnStdoutIsAlone) {
  const CommandRun trained = train({"--json", "-"});
  EXPECT_EQ(json::parse(trained.output)["name"], "toys");
  const CommandRun found = detect("bumps.pcd", {"--json", "-"});
  EXPECT_EQ(json::parse(found.output)["clouds"].size(), 1u);
}

TEST_F(CommandLine, SeveralCloudsGiveNumberedPictures) {
  ASSERT_EQ(train().status, 0);
  const CommandRun found = detect("bumps.pcd", {path("bumps.pcd"), "--image", path("p.jpg"), "--json", path("f.json")});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(readTextFile(path("p_1.jpg")), StartsWith("\xff\xd8"));
  EXPECT_THAT(readTextFile(path("p_2.jpg")), StartsWith("\xff\xd8"));
  EXPECT_EQ(json::parse(readTextFile(path("f.json")))["clouds"].size(), 2u);
}

TEST_F(CommandLine, DetectionStartsFromTheSettingsOfTheCodebook) {
  ASSERT_EQ(train({"--set", "descriptor.radius=0.04", "--set", "detection.threshold=0.99"}).status, 0);
  const CommandRun found = detect("bumps.pcd", {"--json", "-"});
  EXPECT_EQ(json::parse(found.output)["threshold"], 0.99);
  EXPECT_EQ(detect("bumps.pcd", {"--set", "descriptor.radius=0.04"}).status, 0);
  EXPECT_THAT(failure(detect("bumps.pcd", {"--set", "descriptor.radius=0.05"})),
              AllOf(HasSubstr("descriptor.radius"), HasSubstr("0.04"), HasSubstr("0.05"), HasSubstr("train")));
}

TEST_F(CommandLine, ObjectsMayHaveThresholdsOfTheirOwn) {
  ASSERT_EQ(train({"--set", "detection.threshold=1"}).status, 0);
  const auto found = [&](const std::string& thresholds) {
    const CommandRun run = detect("bumps.pcd", {"--json", "-", "--set", "detection.thresholds=" + thresholds});
    EXPECT_EQ(run.status, 0) << run.errors;
    return std::make_pair(json::parse(run.output), run.errors);
  };
  const auto [usual, no_warning] = found("");
  EXPECT_EQ(usual["clouds"][0]["detections"].size(), 0u);
  EXPECT_EQ(usual["thresholds"], json::object());
  const auto [low, low_warning] = found("bumps=0.5");
  EXPECT_EQ(low["clouds"][0]["detections"].size(), 1u);
  EXPECT_EQ(low["thresholds"], json({{"bumps", 0.5}}));
  EXPECT_EQ(no_warning + low_warning, "");
  const auto [other, warning] = found("bump=0.5");
  EXPECT_EQ(other["clouds"][0]["detections"].size(), 0u);
  EXPECT_THAT(warning, HasSubstr("'bump' is not in the codebook; did you mean 'bumps'?"));
  EXPECT_THAT(failure(detect("bumps.pcd", {"--set", "detection.thresholds=bumps"}), 2), HasSubstr("object=score"));
}

TEST_F(CommandLine, UnusableCodebooks) {
  const std::string start = "sks: cannot read codebook '" + path("toys.sks") + "': ";
  EXPECT_EQ(failure(detect("bumps.pcd")), start + "No such file or directory\n");
  ASSERT_EQ(train().status, 0);
  const std::string whole = readTextFile(path("toys.sks"));
  const auto refused = [&](const std::string& content, const std::string& message) {
    test::writeFile(path("toys.sks"), content);
    EXPECT_EQ(failure(detect("bumps.pcd")), start + message + "\n");
    EXPECT_EQ(failure(runSks({"info", path("toys.sks")})), start + message + "\n");
    EXPECT_EQ(failure(runSks({"verify", path("toys.sks")})), start + message + "\n");
  };
  refused("", "it is empty; train it again");
  refused(asciiPcd({"0 0 1"}), "it is no codebook");
  refused(whole.substr(0, whole.size() / 2), "it is truncated: " + std::to_string(whole.size() / 2) + " of " +
                                                 std::to_string(whole.size()) + " bytes; copy it again");
  std::string flipped = whole;
  flipped[whole.size() / 3] = char(flipped[whole.size() / 3] ^ 4);
  refused(flipped, "it is damaged (its checksum does not match); copy or train it again");
}

TEST_F(CommandLine, UnusableClouds) {
  ASSERT_EQ(train().status, 0);
  test::writeFile(path("empty.pcd"), asciiPcd({}));
  test::writeFile(path("nan.pcd"), asciiPcd({"nan nan nan", "nan 0 1", "inf 0 1"}));
  test::writeFile(path("one.pcd"), asciiPcd({"0 0 1"}));
  test::writeFile(path("foreign.pcd"), "hello\n");
  EXPECT_THAT(failure(detect("empty.pcd")),
              AllOf(HasSubstr(path("empty.pcd")), HasSubstr("the cloud is empty (0 points)")));
  EXPECT_THAT(failure(detect("nan.pcd")), AllOf(HasSubstr(path("nan.pcd")), HasSubstr("3 are NaN or infinite")));
  EXPECT_THAT(failure(detect("one.pcd")), AllOf(HasSubstr(path("one.pcd")), HasSubstr("1 usable points")));
  EXPECT_EQ(failure(detect("none.pcd")),
            "sks: cannot read cloud '" + path("none.pcd") + "': No such file or directory\n");
  EXPECT_EQ(failure(detect("foreign.pcd")),
            "sks: cannot read cloud '" + path("foreign.pcd") + "': it is neither a PCD nor a PLY file\n");
}

TEST_F(CommandLine, CloudsThatWereScaledTwiceAreNamed) {
  ASSERT_EQ(train().status, 0);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(
      failure(detect("bumps.pcd", {"--scale", "0.001"})),
      AllOf(HasSubstr("the cloud is too small: it is "), HasSubstr(" mm large, and surface.normal_radius is 10 mm"),
            HasSubstr("do not scale it to metres again")));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);
  test::writeFile(path("toys.yaml"),
                  "name: toys\nunits: mm\ntraining:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n");
  EXPECT_THAT(failure(train()), HasSubstr("bumps.pcd: the cloud is too small"));
}

TEST_F(CommandLine, MillimetresAreNamedAndCanBeScaled) {
  ASSERT_EQ(train().status, 0);
  Cloud cloud = test::bumps();
  for (Eigen::Vector3f& point : cloud.points) point *= 1000;
  writeCloud(path("mm.pcd"), cloud);
  EXPECT_THAT(failure(detect("mm.pcd")),
              AllOf(HasSubstr(path("mm.pcd")), HasSubstr("millimetres"), HasSubstr("--scale 0.001")));
  const CommandRun found = detect("mm.pcd", {"--scale", "0.001", "--json", "-"});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_EQ(json::parse(found.output)["clouds"][0]["detections"][0]["object"], "bumps");
}

TEST_F(CommandLine, PlyWithDoublesIsRead) {
  ASSERT_EQ(train().status, 0);
  const Cloud cloud = test::bumps();
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(cloud.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const Eigen::Vector3f& p : cloud.points) {
    ply += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  }
  test::writeFile(path("bumps.ply"), ply);
  const CommandRun found = detect("bumps.ply", {"--json", "-"});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_EQ(json::parse(found.output)["clouds"][0]["detections"][0]["object"], "bumps");
}

TEST_F(CommandLine, ColourCodebookNeedsAColouredCloud) {
  writeCloud(path("bumps.pcd"), test::bumps(true));
  ASSERT_EQ(train().status, 0);
  EXPECT_EQ(detect("bumps.pcd").status, 0);
  writeCloud(path("grey.pcd"), test::bumps(false));
  EXPECT_THAT(failure(detect("grey.pcd")),
              AllOf(HasSubstr(path("grey.pcd")), HasSubstr("CSHOT"), HasSubstr("descriptor.type=shot")));
}

TEST_F(CommandLine, UnusableDataSets) {
  writeDataSet("training:\n  - {object: bumps, clod: bumps.pcd, kind: view}\n");
  EXPECT_THAT(failure(train()),
              AllOf(HasSubstr(path("toys.yaml") + ":5: "), HasSubstr("'clod'"), HasSubstr("'cloud'")));
  writeDataSet("training:\n  - {object: bumps, cloud: none.pcd, kind: view}\n");
  EXPECT_THAT(failure(train()), AllOf(HasSubstr(path("toys.yaml")), HasSubstr("none.pcd")));
  test::writeFile(path("toys.yaml"), "name: toys\nunits: ell\nmax_distance: 0.05\ntraining: []\n");
  EXPECT_THAT(failure(train()), AllOf(HasSubstr(path("toys.yaml") + ":2: "), HasSubstr("units")));
  writeDataSet("scenes: []\n");
  EXPECT_THAT(failure(train()), AllOf(HasSubstr(path("toys.yaml")), HasSubstr("training")));
  EXPECT_EQ(failure(runSks({"train", "-d", path("none.yaml"), "-o", path("toys.sks")})),
            "sks: cannot read '" + path("none.yaml") + "': No such file or directory\n");
  test::writeFile(path("nan.pcd"), asciiPcd(std::vector<std::string>(20, "nan nan nan")));
  writeDataSet(
      "training:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n  - {object: bumps, cloud: nan.pcd, kind: "
      "view}\n");
  EXPECT_THAT(failure(train()), HasSubstr("nan.pcd"));
  EXPECT_FALSE(std::filesystem::exists(path("toys.sks")));
}

TEST_F(CommandLine, FailedTrainingKeepsTheOldCodebook) {
  test::writeFile(path("toys.sks"), "old");
  writeDataSet("training:\n  - {object: bumps, cloud: none.pcd, kind: view}\n");
  const std::size_t files = folder_.fileCount();
  failure(train());
  EXPECT_EQ(readTextFile(path("toys.sks")), "old");
  EXPECT_EQ(folder_.fileCount(), files);
}

TEST_F(CommandLine, OutputsThatCannotBeWrittenAreFoundBeforeTheWork) {
  const std::string reason = ": the folder " + path("none") + " does not exist; create it first\n";
  EXPECT_EQ(failure(runSks({"train", "-d", path("toys.yaml"), "-o", path("none/a.sks")})),
            "sks: cannot write '" + path("none/a.sks") + "'" + reason);
  EXPECT_EQ(failure(train({"--json", path("none/a.json")})),
            "sks: cannot write '" + path("none/a.json") + "'" + reason);
  EXPECT_FALSE(std::filesystem::exists(path("toys.sks")));
  ASSERT_EQ(train().status, 0);
  EXPECT_EQ(failure(detect("bumps.pcd", {"--image", path("none/a.png")})),
            "sks: cannot write '" + path("none/a.png") + "'" + reason);
  EXPECT_EQ(failure(detect("bumps.pcd", {"--image", path("a.gif")}), 2),
            "sks: cannot tell the kind of picture from '" + path("a.gif") + "'; let it end in .png or .jpg\n");
}

TEST_F(CommandLine, FailedDetectionWritesNoJson) {
  ASSERT_EQ(train().status, 0);
  const CommandRun run = detect("bumps.pcd", {path("none.pcd"), "--json", path("found.json")});
  EXPECT_EQ(run.status, 1);
  EXPECT_FALSE(std::filesystem::exists(path("found.json")));
}

// A terminal of the test's own tells when the training has begun: only there does a bar show its progress.
TEST_F(CommandLine, InterruptedTrainingLeavesNothing) {
  std::string entries = "training:\n";
  for (int i = 0; i < 2000; ++i) entries += "  - {object: bumps, cloud: bumps.pcd, kind: view}\n";
  writeDataSet(entries);
  const std::size_t files = folder_.fileCount();
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  const std::string name = ::ptsname(terminal);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open(name.c_str(), O_RDWR | O_NOCTTY), STDERR_FILENO);
    ::execl(SKS_EXECUTABLE, "sks", "train", "-d", path("toys.yaml").c_str(), "-o", path("toys.sks").c_str(), nullptr);
    ::_exit(127);
  }
  ASSERT_GT(child, 0);
  std::string shown;
  char block[256];
  for (ssize_t size = 1; size > 0 && shown.find("/2000") == std::string::npos; shown.append(block, size)) {
    size = std::max<ssize_t>(::read(terminal, block, sizeof(block)), 0);
  }
  ::kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ::close(terminal);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status << ": " << shown;
  EXPECT_EQ(folder_.fileCount(), files);
}

TEST_F(CommandLine, OldNamesOfSettingsAreWarnedAbout) {
  const CommandRun set = runSks({"settings", "--json", "-", "--set", "verification.candidates=0"});
  EXPECT_EQ(set.status, 0);
  EXPECT_EQ(set.errors,
            "sks: warning: --set verification.candidates=0: 'verification.candidates = 0' is now called "
            "'detection.hypotheses = hough'; the old name still works\n");
  for (const json& entry : json::parse(set.output)) {
    if (entry["key"] == "detection.hypotheses") {
      EXPECT_EQ(entry["value"], "hough");
    } else {
      EXPECT_EQ(entry["value"], entry["default"]) << entry["key"];
    }
  }
  test::writeFile(path("c.yaml"), "verification:\n  ambiguity: 1.5\n");
  const CommandRun config =
      runSks({"settings", "--yaml", "--config", path("c.yaml"), "--set", "matching.ambiguity=1.4"});
  EXPECT_EQ(config.errors, "sks: warning: " + path("c.yaml") +
                               ":2: 'verification.ambiguity' is now called 'matching.ambiguity'; the old name still "
                               "works\n");
  EXPECT_THAT(config.output, HasSubstr("\n  ambiguity: 1.4\n"));
}

TEST_F(CommandLine, CodebooksWithOldNamesOfSettingsAreUsed) {
  ASSERT_EQ(train().status, 0);
  const CommandRun found = detect("bumps.pcd", {"--json", "-"});
  ASSERT_EQ(found.status, 0) << found.errors;
  test::writeFile(path("toys.sks"),
                  test::withOldSettings(readTextFile(path("toys.sks")), readCodebook(path("toys.sks"))->settings, 80));
  EXPECT_EQ(runSks({"verify", path("toys.sks")}).status, 0);
  const CommandRun info = runSks({"info", path("toys.sks"), "--json", "-"});
  EXPECT_EQ(info.errors, "");
  EXPECT_EQ(json::parse(info.output)["settings"]["matching.ambiguity"], 1.3);
  const CommandRun again = detect("bumps.pcd", {"--json", "-"});
  EXPECT_EQ(again.errors, found.errors);
  const auto detectionsOf = [](const CommandRun& run) { return json::parse(run.output)["clouds"][0]["detections"]; };
  EXPECT_EQ(detectionsOf(again), detectionsOf(found));
  EXPECT_FALSE(detectionsOf(found).empty());
}

TEST_F(CommandLine, SettingsArePrintedInEveryForm) {
  const CommandRun yaml = runSks({"settings", "--yaml", "--set", "keypoints.discard=0.25"});
  Settings settings;
  parseSettings(yaml.output, "stdout", settings);
  EXPECT_EQ(settings.keypoints.discard, 0.25);
  const CommandRun table = runSks({"settings"});
  const CommandRun markdown = runSks({"settings", "--markdown"});
  const json list = json::parse(runSks({"settings", "--json", "-"}).output);
  ASSERT_EQ(list.size(), settingInfos().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const SettingInfo& info = settingInfos()[i];
    EXPECT_EQ(list[i]["key"], info.key);
    EXPECT_EQ(list[i]["help"], info.help);
    EXPECT_EQ(list[i]["value"], list[i]["default"]);
    EXPECT_THAT(table.output, HasSubstr("\n" + info.key + " "));
    EXPECT_THAT(markdown.output, HasSubstr("\n| `" + info.key + "` | " + info.default_value + " | "));
  }
}

}  // namespace sks

#endif
