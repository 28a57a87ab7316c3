// SPDX-License-Identifier: BSD-3-Clause
#include "io/confined_path.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

class ConfinedPath : public ::testing::Test {
protected:
  ConfinedPath() {
    fs::create_directories(inside() + "/sub");
    fs::create_directories(folder_.path("outside"));
    test::writeFile(inside() + "/file", "");
    test::writeFile(folder_.path("outside/secret"), "");
  }

  std::string root() const { return fs::canonical(folder_.path()).string(); }
  std::string inside() const { return folder_.path("inside"); }
  std::string refusal(const std::string& path) const {
    return errorOf(ErrorCode::bad_usage, [&] { confinedPath(path, inside()); });
  }
  void expectOutside(const std::string& path) const {
    EXPECT_THAT(refusal(path), AllOf(HasSubstr("'" + path + "'"), HasSubstr("outside"), HasSubstr(inside())));
  }

  test::TemporaryFolder folder_;
};

TEST_F(ConfinedPath, TakesWhatLiesInside) {
  EXPECT_EQ(confinedPath("file", inside()), root() + "/inside/file");
  EXPECT_EQ(confinedPath("./sub/../file", inside()), root() + "/inside/file");
  EXPECT_EQ(confinedPath("sub/new.sks", inside()), root() + "/inside/sub/new.sks");
  EXPECT_EQ(confinedPath("new/folder/new.sks", inside() + "/"), root() + "/inside/new/folder/new.sks");
  EXPECT_EQ(confinedPath(inside() + "/file", inside()), root() + "/inside/file");
  EXPECT_EQ(confinedPath("../inside/file", inside()), root() + "/inside/file");
  EXPECT_EQ(confinedPath("..file", inside()), root() + "/inside/..file");
}

TEST_F(ConfinedPath, NeedsNoFolder) {
  EXPECT_EQ(confinedPath("a.sks", folder_.path("later/on")), root() + "/later/on/a.sks");
  EXPECT_EQ(confinedPath("etc/hostname", "/"), confinedPath("/etc/hostname", "/"));
}

TEST_F(ConfinedPath, RefusesWaysOut) {
  expectOutside("../outside/secret");
  expectOutside("..");
  expectOutside("../new");
  expectOutside("sub/../../outside/secret");
  expectOutside("missing/../../outside/secret");
  expectOutside("missing/../../new");
  expectOutside("/etc/passwd");
  expectOutside(folder_.path("outside/secret"));
  expectOutside("//etc/passwd");
}

TEST_F(ConfinedPath, RefusesAFolderOfWhichOursIsAPrefix) {
  fs::create_directories(folder_.path("inside2"));
  expectOutside(folder_.path("inside2/file"));
  expectOutside("../inside2/file");
}

TEST_F(ConfinedPath, RefusesLinksThatPointOut) {
  fs::create_symlink("../outside/secret", inside() + "/file_link");
  fs::create_directory_symlink(folder_.path("outside"), inside() + "/folder_link");
  fs::create_symlink("folder_link", inside() + "/link_to_link");
  expectOutside("file_link");
  expectOutside("folder_link");
  expectOutside("folder_link/secret");
  expectOutside("folder_link/new.sks");
  expectOutside("link_to_link/new.sks");
  expectOutside("folder_link/../inside2");
}

TEST_F(ConfinedPath, RefusesLinksToNothing) {
  fs::create_symlink(folder_.path("outside/new"), inside() + "/dangling");
  fs::create_symlink("loop", inside() + "/loop");
  EXPECT_THAT(refusal("dangling"), AllOf(HasSubstr("dangling"), HasSubstr(inside())));
  EXPECT_THAT(refusal("dangling/file"), HasSubstr("dangling"));
  EXPECT_THAT(refusal("loop"), HasSubstr("loop"));
}

TEST_F(ConfinedPath, FollowsLinksThatStayInside) {
  fs::create_symlink("../file", inside() + "/sub/link");
  EXPECT_EQ(confinedPath("sub/link", inside()), root() + "/inside/file");
  fs::create_directory_symlink(inside(), folder_.path("alias"));
  EXPECT_EQ(confinedPath("file", folder_.path("alias")), root() + "/inside/file");
  EXPECT_EQ(confinedPath(inside() + "/file", folder_.path("alias")), root() + "/inside/file");
}

TEST_F(ConfinedPath, RefusesWhatIsNoName) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("."), HasSubstr("names a folder"));
  EXPECT_THAT(refusal(inside()), HasSubstr("names a folder"));
  EXPECT_THAT(refusal("sub"), HasSubstr("names a folder"));
  EXPECT_THAT(refusal("sub/"), HasSubstr("names a folder"));
  EXPECT_THAT(refusal("new/"), HasSubstr("names a folder"));
  EXPECT_THAT(refusal("~/file"), HasSubstr("not expanded"));
  EXPECT_THAT(refusal(std::string("file\0/../../x", 13)),
              AllOf(HasSubstr("null"), Not(HasSubstr(std::string(1, '\0')))));
  EXPECT_THAT(refusal(std::string(5000, 'a')), HasSubstr("5000 bytes"));
  EXPECT_THAT(refusal(std::string(300, 'a')), HasSubstr("too long"));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [] { confinedPath("file", ""); }), HasSubstr("no folder"));
}

TEST(CheckFileName, RefusesWhatIsNotOneName) {
  const auto refusal = [](const std::string& name) {
    return errorOf(ErrorCode::bad_usage, [&] { checkFileName(name, "the object's name"); });
  };
  for (const char* name : {"mug", "tea pot", "K\xc3\xa4se", "a..b", "007"})
    EXPECT_NO_THROW(checkFileName(name, "")) << name;
  EXPECT_THAT(refusal(""), HasSubstr("the object's name '' is refused: it is empty"));
  EXPECT_THAT(refusal("a/b"), HasSubstr("slash"));
  EXPECT_THAT(refusal("a\\b"), HasSubstr("slash"));
  EXPECT_THAT(refusal(".."), HasSubstr("dot"));
  EXPECT_THAT(refusal(".hidden"), HasSubstr("dot"));
  EXPECT_THAT(refusal("a\nb"), HasSubstr("control"));
  EXPECT_THAT(refusal(std::string("a\0b", 3)), HasSubstr("control"));
  EXPECT_THAT(refusal(std::string(101, 'a')), HasSubstr("longer than 100"));
  for (const char* name : {"\xedug", "a\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xef\xbf\xbf", "\xf4\x90\x80\x80"}) {
    EXPECT_THAT(refusal(name), HasSubstr("not UTF-8"));
  }
  for (const char* name : {"\xe2\x98\x95", "\xf0\x9f\x8d\xb5"}) EXPECT_NO_THROW(checkFileName(name, "")) << name;
}

}  // namespace
}  // namespace sks
