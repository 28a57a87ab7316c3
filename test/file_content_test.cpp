// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_content.hpp"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::HasSubstr;

class FileContentTest : public ::testing::Test {
protected:
  void write(const std::string& content) const { test::writeFile(path_, content); }

  static std::string contentOf(const FileContent& file) {
    return file.size() == 0 ? "" : std::string(reinterpret_cast<const char*>(file.data()), file.size());
  }

  const test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("file");
};

TEST_F(FileContentTest, HoldsWhatTheFileHolds) {
  std::string content(3000000, '\0');
  for (const std::size_t i : {std::size_t(0), std::size_t(1) << 20, content.size() - 1}) content[i] = char(1 + i % 100);
  write(content);
  EXPECT_EQ(contentOf(FileContent(path_)), content);
  write("");
  EXPECT_EQ(FileContent(path_).size(), 0U);
}

TEST_F(FileContentTest, DoesNotChangeWithTheFile) {
  const std::string content(100000, 'a');
  write(content);
  const FileContent file(path_);
  write(std::string(100000, 'b'));
  EXPECT_EQ(contentOf(file), content);
  write("");
  EXPECT_EQ(contentOf(file), content);
}

TEST_F(FileContentTest, WholePagesAreGivenBackAndNothingBeside) {
  const auto page = std::size_t(::sysconf(_SC_PAGESIZE));
  write(std::string(5 * page, 'a'));
  FileContent file(path_);
  file.release(page / 2, 3 * page);
  EXPECT_EQ(contentOf(file), std::string(page, 'a') + std::string(2 * page, '\0') + std::string(2 * page, 'a'));
  file.release(10, 20);
  EXPECT_EQ(contentOf(file).substr(0, page), std::string(page, 'a'));
}

TEST_F(FileContentTest, ReadsLittleOfAFileThatBeginsOtherwise) {
  write("codebook");
  EXPECT_EQ(contentOf(FileContent(path_, "code")), "codebook");
  EXPECT_EQ(contentOf(FileContent(path_, "coda")), "code");
  EXPECT_EQ(contentOf(FileContent(path_, "codebook and more")), "codebook");
}

TEST_F(FileContentTest, HolesTakeNoMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer keeps what other tests have freed";
#endif
  write("magic");
  ASSERT_EQ(::truncate(path_.c_str(), off_t(1) << 29), 0);
  const FileContent file(path_, "magic");
  EXPECT_EQ(file.size(), std::size_t(1) << 29);
  std::size_t resident = 0;
  std::ifstream statm("/proc/self/statm");
  statm >> resident >> resident;
  EXPECT_LT(double(resident) * double(::sysconf(_SC_PAGESIZE)), 3e8);
}

TEST_F(FileContentTest, SaysWhyItCannotRead) {
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { FileContent file(path_); }), HasSubstr("No such file"));
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { FileContent file(folder_.path("")); }), HasSubstr("it is a folder"));
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [] { FileContent file("/dev/null"); }), HasSubstr("no regular file"));
}

}  // namespace
}  // namespace sks
