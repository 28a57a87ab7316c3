// SPDX-License-Identifier: BSD-3-Clause
// Nothing that is read can block: a pipe without a writer is refused at once.
#include "io/regular_file.hpp"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/codebook_file.hpp>
#include <sks_detector/settings_file.hpp>

#include "error_of.hpp"
#include "io/dataset.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

class RegularFiles : public ::testing::Test {
protected:
  RegularFiles() { EXPECT_EQ(::mkfifo(pipe_.c_str(), 0600), 0); }

  template <typename Read>
  void expectRefused(Read read) const {
    for (const std::string& path : {pipe_, std::string("/dev/zero")}) {
      EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { read(path); }),
                  HasSubstr("it is no regular file but a pipe or device"));
    }
  }

  test::TemporaryFolder folder_;
  std::string pipe_ = folder_.path("pipe");
};

TEST_F(RegularFiles, AreWhatIsRead) {
  test::writeFile(folder_.path("a"), "abc");
  const RegularFile file(folder_.path("a"));
  char text[8] = "";
  EXPECT_EQ(file.size(), 3u);
  EXPECT_EQ(file.read(text, 8, 1), 2u);
  EXPECT_STREQ(text, "bc");
}

TEST_F(RegularFiles, AllReadersRefusePipesAndDevices) {
  expectRefused([](const std::string& path) { RegularFile file(path); });
  expectRefused([](const std::string& path) { readTextFile(path); });
  expectRefused([](const std::string& path) { readCloud(path); });
  expectRefused([](const std::string& path) { readColorImage(path); });
  expectRefused([](const std::string& path) { readDepthImage(path); });
  expectRefused([](const std::string& path) { readCodebook(path); });
  expectRefused([](const std::string& path) { loadDataSet(path); });
  expectRefused([](const std::string& path) {
    Settings settings;
    loadSettings(path, settings);
  });
}

}  // namespace
}  // namespace sks
