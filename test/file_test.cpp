// SPDX-License-Identifier: BSD-3-Clause
#include "io/file.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "io/atomic_file.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace {

using sks::test::TemporaryFolder;

template <typename Action>
std::string fileError(Action action) {
  return sks::test::errorOf(sks::ErrorCode::bad_file, action);
}

}  // namespace

TEST(File, WritesAndReplaces) {
  const TemporaryFolder folder;
  sks::writeFileAtomically(folder.path("a.txt"), "first");
  sks::writeFileAtomically(folder.path("a.txt"), "second, longer");
  EXPECT_EQ(sks::readTextFile(folder.path("a.txt")), "second, longer");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(File, HonoursTheUmask) {
  const TemporaryFolder folder;
  const mode_t previous = ::umask(027);
  sks::writeFileAtomically(folder.path("a.txt"), "x");
  ::umask(previous);
  EXPECT_EQ(fs::status(folder.path("a.txt")).permissions(), fs::perms(0640));
}

TEST(File, AbandonedFileLeavesTheOldOneAndNoRest) {
  const TemporaryFolder folder;
  sks::writeFileAtomically(folder.path("a.txt"), "old");
  {
    sks::AtomicFile file(folder.path("a.txt"));
    file.write("new", 3);
    EXPECT_EQ(folder.fileCount(), 2u);
  }
  EXPECT_EQ(folder.fileCount(), 1u);
  EXPECT_EQ(sks::readTextFile(folder.path("a.txt")), "old");
}

TEST(File, NamesMayBeAsLongAsTheFileSystemTakes) {
  const TemporaryFolder folder;
  std::string umlauts;
  for (int i = 0; i < 127; ++i) umlauts += "\xc3\xa4";
  for (const std::string& name : {std::string(250, 'x'), std::string(255, 'y'), umlauts}) {
    sks::writeFileAtomically(folder.path(name), name);
    EXPECT_EQ(sks::readTextFile(folder.path(name)), name);
  }
  EXPECT_EQ(folder.fileCount(), 3u);
  const std::string message = fileError([&] { sks::writeFileAtomically(folder.path(std::string(256, 'z')), "z"); });
  EXPECT_NE(message.find("choose a shorter name"), std::string::npos) << message;
}

TEST(File, NewOnesReplaceNothing) {
  const TemporaryFolder folder;
  EXPECT_TRUE(sks::writeNewFileAtomically(folder.path("a.txt"), "first"));
  EXPECT_FALSE(sks::writeNewFileAtomically(folder.path("a.txt"), "second"));
  EXPECT_EQ(sks::readTextFile(folder.path("a.txt")), "first");
  fs::create_symlink("a.txt", folder.path("link.txt"));
  fs::create_symlink("none.txt", folder.path("dangling.txt"));
  EXPECT_FALSE(sks::writeNewFileAtomically(folder.path("link.txt"), "by the link"));
  EXPECT_FALSE(sks::writeNewFileAtomically(folder.path("dangling.txt"), "by the link"));
  EXPECT_EQ(sks::readTextFile(folder.path("a.txt")), "first");
  EXPECT_EQ(folder.fileCount(), 3u);
  EXPECT_TRUE(sks::writeNewFileAtomically("/dev/null", "x"));
}

TEST(File, OfSeveralProcessesThatWriteANewOneAloneDoes) {
  const TemporaryFolder folder;
  constexpr int processes = 4, rounds = 50;
  int start[2];
  ASSERT_EQ(::pipe(start), 0);
  std::vector<pid_t> children;
  for (int i = 0; i < processes; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    ::close(start[1]);
    char byte = 0;
    if (::read(start[0], &byte, 1) != 0) ::_exit(255);  // the end of the pipe: all begin at once
    int won = 0;
    for (int round = 0; round < rounds; ++round) {
      const std::string path = folder.path(std::to_string(round));
      const bool written = sks::writeNewFileAtomically(path, std::to_string(i));
      if (written != (sks::readTextFile(path) == std::to_string(i))) ::_exit(255);
      won += written ? 1 : 0;
    }
    ::_exit(won);
  }
  ::close(start[0]);
  ::close(start[1]);
  int won = 0;
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_NE(WEXITSTATUS(status), 255);
    won += WEXITSTATUS(status);
  }
  EXPECT_EQ(won, rounds);
  EXPECT_EQ(folder.fileCount(), std::size_t(rounds));
}

TEST(File, FollowsSymbolicLinks) {
  const TemporaryFolder folder;
  sks::writeFileAtomically(folder.path("real.txt"), "old");
  fs::create_symlink("real.txt", folder.path("link.txt"));
  sks::writeFileAtomically(folder.path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path("link.txt")));
  EXPECT_EQ(sks::readTextFile(folder.path("real.txt")), "new");
}

TEST(File, WritesToDevicesWithoutReplacingThem) {
  sks::writeFileAtomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(File, WriteErrorsNameThePathAndTheRemedy) {
  const TemporaryFolder folder;
  EXPECT_EQ(fileError([&] { sks::writeFileAtomically(folder.path("none/a.txt"), "x"); }),
            "cannot write '" + folder.path("none/a.txt") + "': the folder " + folder.path("none") +
                " does not exist; create it first");
  EXPECT_EQ(fileError([&] { sks::writeFileAtomically(folder.path(), "x"); }),
            "cannot write '" + folder.path() + "': it is a folder; give the name of a file");
  EXPECT_EQ(fileError([&] { sks::writeFileAtomically("", "x"); }), "cannot write '': the name is empty");
}

TEST(File, FullDeviceIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(fileError([&] { sks::writeFileAtomically("/dev/full", "x"); }),
            "cannot write '/dev/full': No space left on device");
}

TEST(File, ReadOnlyFolderIsNamed) {
  const TemporaryFolder folder;
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const std::string message = fileError([&] { sks::writeFileAtomically(folder.path("a.txt"), "x"); });
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(message,
            "cannot write '" + folder.path("a.txt") + "': Permission denied; choose a folder that can be written to");
}

TEST(File, ReadErrorsNameThePath) {
  const TemporaryFolder folder;
  EXPECT_EQ(fileError([&] { sks::readTextFile(folder.path("none.txt")); }),
            "cannot read '" + folder.path("none.txt") + "': No such file or directory");
  EXPECT_EQ(fileError([&] { sks::readTextFile(folder.path()); }),
            "cannot read '" + folder.path() + "': it is a folder; give the name of a file");
  sks::writeFileAtomically(folder.path("big.txt"), std::string(200000, 'x'));
  EXPECT_EQ(fileError([&] { sks::readTextFile(folder.path("big.txt"), 100000); }),
            "cannot read '" + folder.path("big.txt") + "': it is larger than 100000 bytes");
  EXPECT_EQ(sks::readTextFile(folder.path("big.txt"), 200000).size(), 200000u);
}
