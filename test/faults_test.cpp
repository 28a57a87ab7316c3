// SPDX-License-Identifier: BSD-3-Clause
// What a power cut, a kill, a full disk or a read-only one leaves behind: the old file or the new one, never a half of
// either. SKS_FAULT_RUNS kills each writer so many times, by default 6: a few that tell of a broken one at once.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>

#include "bumps.hpp"
#include "error_of.hpp"
#include "io/captured_views.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

#ifdef SKS_EXECUTABLE
#include "run_sks.hpp"
#endif

namespace sks {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using test::errorOf;
using test::TemporaryFolder;
using ::testing::HasSubstr;

int runs() {
  const char* text = std::getenv("SKS_FAULT_RUNS");
  return text == nullptr ? 6 : std::atoi(text);
}

Codebook codebookOf(const std::string& name, std::size_t words) {
  Codebook codebook;
  codebook.name = name;
  codebook.descriptor_type = codebook.settings.descriptor.type = DescriptorType::shot;
  codebook.objects = {"mug"};
  codebook.views.resize(1);
  codebook.words.resize(words);
  codebook.descriptors = QuantizedDescriptors(DescriptorMatrix(std::vector<float>(words * 352, 0.5f), 352));
  return codebook;
}

/// Calls `f` in a process of its own, over and over, until killed.
template <typename Function>
pid_t repeatInChild(Function f) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  try {
    for (;;) f();
  } catch (...) {
  }
  ::_exit(1);
}

/// Kills a process after a random time [s]; false if it had ended by itself.
bool killWithin(pid_t child, double longest, std::mt19937& random) {
  std::this_thread::sleep_for(duration<double>(std::uniform_real_distribution<>(0, longest)(random)));
  ::kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFSIGNALED(status);
}

/// A file system of its own in a folder, where the test may mount one.
class SmallDisk {
public:
  explicit SmallDisk(const std::string& options) : options_(options) {
    mounted_ = ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.path().c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  std::string path(const std::string& name) const { return folder_.path(name); }
  void makeReadOnly() const {
    ASSERT_EQ(::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, options_.c_str()), 0);
  }
  std::size_t fileCount() const { return folder_.fileCount(); }

private:
  TemporaryFolder folder_;
  std::string options_;
  bool mounted_ = false;
};

#define SKIP_UNLESS_MOUNTED(disk) \
  if (!(disk).mounted()) GTEST_SKIP() << "only root may mount a small file system"

/// Limits the size of files that this process writes, in its scope.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  rlimit before_{};
};

}  // namespace

TEST(Faults, KilledSaveLeavesTheOldCodebookOrTheNewOne) {
  const TemporaryFolder folder;
  const std::string path = folder.path("toys.sks");
  const Codebook first = codebookOf("first", 300), second = codebookOf("second", 700);
  const std::uint32_t sums[] = {codebookChecksum(first), codebookChecksum(second)};
  writeCodebook(path, first);
  std::mt19937 random(1);
  for (int run = 0; run < 5 * runs(); ++run) {
    const pid_t child = repeatInChild([&, next = run]() mutable { writeCodebook(path, next++ % 2 ? first : second); });
    ASSERT_TRUE(killWithin(child, 0.02, random));
    EXPECT_THAT(sums, testing::Contains(codebookChecksum(*readCodebook(path)))) << "run " << run;
  }
}

TEST(Faults, KilledCaptureLosesNoView) {
  const TemporaryFolder folder;
  Cloud cloud;
  cloud.points.assign(100, Eigen::Vector3f(0, 0, 1));
  cloud.width = 100;
  std::size_t before = 0;
  std::mt19937 random(2);
  for (int run = 0; run < runs(); ++run) {
    CapturedViews views(folder.path("captured"));
    const pid_t child = repeatInChild([&] { views.add("mug", cloud); });
    const double patience = before == 0 ? run + 1 : 1;  // a busy machine takes long to begin
    ASSERT_TRUE(killWithin(child, 0.02 * patience, random));
    const DataSet after = CapturedViews(folder.path("captured")).read();
    EXPECT_GE(after.training.size(), before);
    before = after.training.size();
    for (const TrainingEntry& entry : after.training) ASSERT_EQ(readCloud(entry.path).size(), 100u) << entry.path;
  }
  EXPECT_GT(before, 0u);
}

TEST(Faults, FullDiskKeepsTheOldCodebook) {
  const SmallDisk disk("size=256k");
  SKIP_UNLESS_MOUNTED(disk);
  writeCodebook(disk.path("toys.sks"), codebookOf("old", 20));
  const std::string before = readTextFile(disk.path("toys.sks"));
  EXPECT_EQ(errorOf(ErrorCode::bad_file, [&] { writeCodebook(disk.path("toys.sks"), codebookOf("new", 1500)); }),
            "cannot write '" + disk.path("toys.sks") + "': No space left on device");
  EXPECT_EQ(readTextFile(disk.path("toys.sks")), before);
  EXPECT_EQ(disk.fileCount(), 1u);
}

TEST(Faults, FullDiskKeepsTheCapturedViews) {
  const SmallDisk disk("size=256k");
  SKIP_UNLESS_MOUNTED(disk);
  CapturedViews views(disk.path("captured"));
  Cloud cloud;
  cloud.points.assign(5000, Eigen::Vector3f(0, 0, 1));
  cloud.width = 5000;
  std::size_t stored = 0;
  const std::string message = errorOf(ErrorCode::bad_file, [&] {
    for (;; ++stored) views.add("mug", cloud);
  });
  EXPECT_THAT(message, HasSubstr("No space left on device"));
  EXPECT_GE(stored, 2u);
  ASSERT_EQ(views.read().training.size(), stored);
  for (const TrainingEntry& entry : views.read().training) EXPECT_EQ(readCloud(entry.path).size(), 5000u);
}

TEST(Faults, ViewThatCannotBeListedLeavesNoFile) {
  const SmallDisk disk("size=256k");
  SKIP_UNLESS_MOUNTED(disk);
  CapturedViews views(disk.path("captured"));
  Cloud cloud;
  cloud.points.assign(100, Eigen::Vector3f(0, 0, 1));  // in a page of its own
  cloud.width = 100;
  const auto first = views.add("mug", cloud);
  const auto free_pages = fs::space(disk.path("captured")).available / 4096;
  ASSERT_GT(free_pages, 1u);
  test::writeFile(disk.path("filler"), std::string(4096 * (free_pages - 1), 'x'));
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { views.add("mug", cloud); }),
              testing::AllOf(HasSubstr(views.file()), HasSubstr("No space left on device")));
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(first.file).parent_path()), {}), 1);
  fs::remove(disk.path("filler"));
  EXPECT_EQ(views.add("mug", cloud).views, 2u);
}

TEST(Faults, ReadOnlyDiskIsNamedAndKeepsTheOldFile) {
  const SmallDisk disk("size=256k");
  SKIP_UNLESS_MOUNTED(disk);
  writeCodebook(disk.path("toys.sks"), codebookOf("old", 20));
  disk.makeReadOnly();
  EXPECT_EQ(
      errorOf(ErrorCode::bad_file, [&] { writeCodebook(disk.path("toys.sks"), codebookOf("new", 20)); }),
      "cannot write '" + disk.path("toys.sks") + "': Read-only file system; choose a folder that can be written to");
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { CapturedViews(disk.path("captured")).add("mug", test::bumps()); }),
              HasSubstr("Read-only file system"));
  EXPECT_EQ(readCodebook(disk.path("toys.sks"))->name, "old");
}

TEST(Faults, LimitOfFileSizeIsAnErrorAndNoSignal) {
  const TemporaryFolder folder;
  writeCodebook(folder.path("toys.sks"), codebookOf("old", 1));
  {
    const FileSizeLimit limit(65536);
    EXPECT_EQ(errorOf(ErrorCode::bad_file, [&] { writeCodebook(folder.path("toys.sks"), codebookOf("new", 500)); }),
              "cannot write '" + folder.path("toys.sks") + "': File too large");
  }
  EXPECT_EQ(readCodebook(folder.path("toys.sks"))->name, "old");
  EXPECT_EQ(folder.fileCount(), 1u);
  writeCodebook(folder.path("toys.sks"), codebookOf("new", 500));
  EXPECT_EQ(readCodebook(folder.path("toys.sks"))->name, "new");
}

#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

namespace {

pid_t startTraining(const std::string& data_set, const std::string& output, const std::string& setting) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
  ::execl(SKS_EXECUTABLE, "sks", "train", "-d", data_set.c_str(), "-o", output.c_str(), "--set", setting.c_str(),
          nullptr);
  ::_exit(127);
}

/// Waits until a process has begun to write a file into a folder, or has ended.
void awaitWriting(pid_t child, const TemporaryFolder& folder, std::size_t files) {
  while (folder.fileCount() <= files) {
    siginfo_t ended{};
    if (::waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == child) return;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace

TEST(Faults, KilledTrainingLeavesTheOldCodebookOrTheNewOne) {
  const TemporaryFolder sources, folder;
  writeCloud(sources.path("bumps.pcd"), test::bumps());
  test::writeFile(sources.path("toys.yaml"),
                  "name: toys\nunits: m\ntraining:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n");
  const std::string path = folder.path("toys.sks");
  std::string wholes[2];
  double takes = 0;  // [s]
  for (int i : {1, 0}) {
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    ::waitpid(startTraining(sources.path("toys.yaml"), path, "ransac.seed=" + std::to_string(i)), &status, 0);
    takes = duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_EQ(status, 0);
    wholes[i] = readTextFile(path);
  }
  ASSERT_NE(wholes[0], wholes[1]);
  std::mt19937 random(3);
  int killed = 0;
  for (int run = 0; run < runs(); ++run) {
    for (const fs::directory_entry& rest : fs::directory_iterator(folder.path())) fs::remove(rest.path());
    test::writeFile(path, wholes[0]);
    const pid_t child = startTraining(sources.path("toys.yaml"), path, "ransac.seed=1");
    if (run % 2 == 1) awaitWriting(child, folder, 1);  // every other one is killed while it writes
    killed += killWithin(child, run % 2 == 1 ? 0.002 : 1.1 * takes, random);
    const std::string left = readTextFile(path);
    EXPECT_TRUE(left == wholes[0] || left == wholes[1]) << "run " << run;
  }
  EXPECT_GT(killed, 0);
}

TEST(Faults, CommandLineOnAFullDiskFailsAndKeepsTheOldCodebook) {
  const SmallDisk disk("size=64k");
  SKIP_UNLESS_MOUNTED(disk);
  const TemporaryFolder sources;
  writeCloud(sources.path("bumps.pcd"), test::bumps());
  test::writeFile(sources.path("toys.yaml"),
                  "name: toys\nunits: m\ntraining:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n");
  writeCodebook(disk.path("toys.sks"), codebookOf("old", 20));
  const auto run = test::runSks({"train", "-d", sources.path("toys.yaml"), "-o", disk.path("toys.sks")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.errors, HasSubstr("cannot write '" + disk.path("toys.sks") + "': No space left on device"));
  EXPECT_EQ(readCodebook(disk.path("toys.sks"))->name, "old");
  EXPECT_EQ(disk.fileCount(), 1u);
}

TEST(Faults, CommandLineSaysWhenItsResultsCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TemporaryFolder folder;
  writeCodebook(folder.path("toys.sks"), codebookOf("toys", 20));
  const std::string codebook = folder.path("toys.sks");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", codebook}, {"info", codebook, "--json", "-"}, {"settings"}}) {
    const auto run = test::runSks(arguments, "/dev/full");
    EXPECT_EQ(run.status, 1) << arguments[0];
    EXPECT_EQ(run.errors, "sks: cannot write the results to stdout\n") << arguments[0];
  }
}

#endif  // SKS_EXECUTABLE

}  // namespace sks
