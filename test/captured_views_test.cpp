// SPDX-License-Identifier: BSD-3-Clause
#include "io/captured_views.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "io/file.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace fs = std::filesystem;

class CapturedViewsTest : public ::testing::Test {
protected:
  CapturedViewsTest() : root_(fs::canonical(temporary_.path()).string()), views_(root_ + "/a/captured") {}

  std::string path(const std::string& name) const { return root_ + "/a/captured/" + name; }
  static Cloud view(float x) { return test::makeCloud({{x, 0, 1}, {0, 1, 1}}); }

  test::TemporaryFolder temporary_;
  std::string root_;
  CapturedViews views_;
};

TEST_F(CapturedViewsTest, AreEmptyAtFirstAndTouchNothing) {
  EXPECT_THAT(views_.objects(), IsEmpty());
  EXPECT_THAT(views_.read().training, IsEmpty());
  EXPECT_EQ(views_.remove("mug"), 0u);
  EXPECT_FALSE(fs::exists(root_ + "/a"));
}

TEST_F(CapturedViewsTest, OutliveARestart) {
  EXPECT_EQ(views_.add("tea pot", view(1)).file, path("tea pot/000.pcd"));
  EXPECT_EQ(views_.add("yes", view(2)).views, 1u);
  const auto added = views_.add("tea pot", view(3));
  EXPECT_EQ(added.file, path("tea pot/001.pcd"));
  EXPECT_EQ(added.views, 2u);

  const DataSet after = CapturedViews(path("")).read();
  EXPECT_EQ(after.name, "captured");
  ASSERT_THAT(after.training, SizeIs(3));
  EXPECT_EQ(after.training[1].object, "yes");
  EXPECT_EQ(after.training[2].source, "tea pot/001.pcd");
  EXPECT_EQ(after.training[2].kind, ViewKind::view);
  EXPECT_EQ(readCloud(after.training[2].path).points[0].x(), 3);
  EXPECT_THAT(CapturedViews(path("")).objects(), ElementsAre("tea pot", "yes"));
}

TEST_F(CapturedViewsTest, RemovesOneObject) {
  views_.add("mug", view(1));
  views_.add("box", view(2));
  views_.add("mug", view(3));
  EXPECT_EQ(views_.remove("mug"), 2u);
  EXPECT_THAT(views_.objects(), ElementsAre("box"));
  EXPECT_FALSE(fs::exists(path("mug")));
  EXPECT_EQ(views_.remove("mug"), 0u);
  EXPECT_EQ(views_.remove("box"), 1u);
  EXPECT_FALSE(fs::exists(path("dataset.yaml")));
  EXPECT_EQ(views_.add("box", view(4)).views, 1u);
}

TEST_F(CapturedViewsTest, LeavesAloneWhatItDidNotStore) {
  views_.add("mug", view(1));
  writeCloud(root_ + "/own.pcd", view(2));
  test::writeFile(path("mug/notes.txt"), "");
  test::writeFile(path("dataset.yaml"),
                  "name: mine\nunits: m\ntraining:\n"
                  "  - {object: mug, cloud: mug/000.pcd, kind: view}\n"
                  "  - {object: mug, cloud: ../../own.pcd, kind: model}\n"
                  "  - {object: box, cloud: ../../own.pcd, kind: model,"
                  " symmetry: {axis: [0, 0, 1], order: inf}}\n");
  views_.add("cup", view(3));
  EXPECT_EQ(views_.remove("mug"), 2u);
  EXPECT_TRUE(fs::exists(root_ + "/own.pcd"));
  EXPECT_TRUE(fs::exists(path("mug/notes.txt")));
  const DataSet after = views_.read();
  EXPECT_EQ(after.name, "mine");
  ASSERT_THAT(after.training, SizeIs(2));
  EXPECT_EQ(after.training[0].kind, ViewKind::model);
  EXPECT_TRUE(after.training[0].symmetry);
}

TEST_F(CapturedViewsTest, NeverReusesAName) {
  views_.add("mug", view(1));
  views_.add("mug", view(2));
  fs::remove(path("mug/000.pcd"));
  test::writeFile(path("dataset.yaml"), "name: c\nunits: m\ntraining: [{object: mug, cloud: mug/001.pcd, kind: view}]");
  EXPECT_EQ(views_.add("mug", view(3)).file, path("mug/002.pcd"));
}

TEST_F(CapturedViewsTest, RefusesNamesThatAreNone) {
  for (const char* name : {"", "..", "a/b", ".mug", "/etc"}) {
    EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { views_.add(name, view(1)); }), HasSubstr("the object's name"));
  }
  EXPECT_FALSE(fs::exists(root_ + "/a"));
}

/// Its folder would be taken for an object that the program makes itself, and no captured view could be read any more.
TEST_F(CapturedViewsTest, RefusesTheNameOfABuiltInObject) {
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { views_.add("builtin:mug", view(1)); }), HasSubstr("'builtin:'"));
  EXPECT_TRUE(views_.objects().empty());
}

TEST_F(CapturedViewsTest, RefusesAFolderThatLeadsOut) {
  fs::create_directories(path(""));
  fs::create_directory_symlink(root_, path("mug"));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { views_.add("mug", view(1)); }), HasSubstr("outside"));
  EXPECT_FALSE(fs::exists(root_ + "/000.pcd"));
}

TEST_F(CapturedViewsTest, KeepsADamagedFileAsItIs) {
  views_.add("mug", view(1));
  for (const char* damaged :
       {"name: [", "name: c\nunits: m\ntraining: [{object: mug, clod: mug/000.pcd, kind: view}]"}) {
    test::writeFile(path("dataset.yaml"), damaged);
    const ErrorCode code = damaged == std::string("name: [") ? ErrorCode::bad_file : ErrorCode::bad_data;
    EXPECT_THAT(errorOf(code, [&] { views_.add("mug", view(2)); }), HasSubstr("dataset.yaml:"));
    EXPECT_THAT(errorOf(code, [&] { views_.remove("mug"); }), HasSubstr("dataset.yaml:"));
    EXPECT_EQ(readTextFile(path("dataset.yaml")), damaged);
  }
  test::writeFile(path("dataset.yaml"),
                  "name: c\nunits: mm\ntraining: [{object: mug, cloud: mug/000.pcd, kind: view}]");
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { views_.add("mug", view(2)); }), HasSubstr("millimetres"));
}

TEST_F(CapturedViewsTest, LeavesOutWhatIsGone) {
  views_.add("mug", view(1));
  views_.add("box", view(2));
  views_.add("mug", view(3));
  views_.add("cup", view(4));
  fs::remove(path("mug/000.pcd"));
  fs::remove_all(path("cup"));
  fs::create_directory(path("cup"));
  fs::create_directory(path("cup/000.pcd"));  // no file either
  const DataSet left = views_.read();
  ASSERT_THAT(left.training, SizeIs(2));
  EXPECT_EQ(left.training[0].path, path("box/000.pcd"));
  EXPECT_EQ(left.training[1].path, path("mug/001.pcd"));
  ASSERT_THAT(left.missing, SizeIs(2));
  EXPECT_THAT(left.warnings,
              ElementsAre(testing::AllOf(HasSubstr("dataset.yaml:"), HasSubstr("'" + path("mug/000.pcd") + "'"),
                                         HasSubstr("'mug'"), HasSubstr("left out")),
                          HasSubstr("'" + path("cup/000.pcd") + "'")));
  EXPECT_THAT(views_.objects(), ElementsAre("box", "mug"));

  EXPECT_EQ(views_.add("mug", view(5)).views, 2u);
  EXPECT_THAT(views_.read().training, SizeIs(3));
  EXPECT_EQ(views_.remove("cup"), 1u);
  EXPECT_EQ(views_.remove("mug"), 3u);
  EXPECT_THAT(views_.read().warnings, IsEmpty());
  fs::remove(path("box/000.pcd"));
  EXPECT_THAT(views_.read().training, IsEmpty());
  EXPECT_THAT(views_.read().missing, SizeIs(1));
}

TEST_F(CapturedViewsTest, OfSeveralProcessesAreAllKept) {
  constexpr int processes = 4, each = 12;
  std::vector<pid_t> children;
  for (int i = 0; i < processes; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    int status = 1;
    try {
      CapturedViews views(root_ + "/a/captured");
      for (int k = 0; k < each; ++k) {
        views.add(i % 2 == 0 ? "shared" : "own " + std::to_string(i), view(float(i)));
        if (k % 4 == 3 && i == 3) views.remove("own 3");
      }
      status = 0;
    } catch (const Error&) {
    }
    ::_exit(status);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  const DataSet all = views_.read();
  EXPECT_THAT(all.warnings, IsEmpty());
  EXPECT_THAT(all.training, SizeIs(3 * each));  // all of "own 3" were removed
  std::map<std::string, int> count;
  for (const TrainingEntry& entry : all.training) {
    ++count[entry.object];
    EXPECT_EQ(readCloud(entry.path).size(), 2u);
  }
  EXPECT_EQ(count["shared"], 2 * each);
  EXPECT_EQ(count["own 1"], each);
}

TEST_F(CapturedViewsTest, KeepThePlane) {
  const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d(0, -0.6, -0.8), 0.75);
  views_.add("mug", view(1), plane);
  views_.add("mug", view(2));
  const DataSet all = views_.read();
  ASSERT_THAT(all.training, SizeIs(2));
  ASSERT_TRUE(all.training[0].plane);
  EXPECT_TRUE(all.training[0].plane->coeffs().isApprox(plane.coeffs(), 1e-9));
  EXPECT_FALSE(all.training[1].plane);
}

TEST_F(CapturedViewsTest, KeepThePoseOfTheCamera) {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(0.1, -2.5, 1.25) * Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized());
  views_.add("mug", view(1), std::nullopt, pose);
  views_.add("mug", view(2));
  const DataSet all = views_.read();
  ASSERT_THAT(all.training, SizeIs(2));
  ASSERT_TRUE(all.training[0].T_fixed_cloud);
  EXPECT_TRUE(all.training[0].T_fixed_cloud->isApprox(pose, 1e-9));
  EXPECT_FALSE(all.training[1].T_fixed_cloud);
  EXPECT_TRUE(trainingSamples(all)[0].T_fixed_source->isApprox(pose, 1e-9));
}

/// Whoever deletes the line of a view deletes that view alone; also in files that were written in one line.
TEST_F(CapturedViewsTest, AreListedOneALine) {
  views_.add("tea pot", view(1), Eigen::Hyperplane<double, 3>(Eigen::Vector3d(0, -0.6, -0.8), 0.75));
  views_.add("mug", view(2));
  test::writeFile(path("dataset.yaml"),
                  "{name: captured, units: m, training: [{object: tea pot, cloud: tea pot/000.pcd, kind: view, plane: "
                  "[0, -0.6, -0.8, 0.75]}, {object: mug, cloud: mug/000.pcd, kind: view}], max_distance: 0.04}\n");
  views_.add("mug", view(3));
  views_.add("mug", view(4));
  const auto linesWith = [&](const std::string& text) {
    std::istringstream lines(readTextFile(path("dataset.yaml")));
    std::vector<std::string> found;
    for (std::string line; std::getline(lines, line);) {
      if (line.find(text) != std::string::npos) found.push_back(line);
    }
    return found;
  };
  EXPECT_THAT(linesWith(".pcd"), SizeIs(4));
  EXPECT_THAT(linesWith("tea pot"), ElementsAre("  - {object: tea pot, cloud: tea pot/000.pcd, kind: view, plane: "
                                                "[0, -0.6, -0.8, 0.75]}"));
  EXPECT_THAT(linesWith("max_distance"), ElementsAre("max_distance: 0.04"));

  std::string text = readTextFile(path("dataset.yaml"));
  const std::string line = linesWith("mug/001.pcd").at(0) + "\n";
  text.erase(text.find(line), line.size());
  test::writeFile(path("dataset.yaml"), text);
  const DataSet left = CapturedViews(path("")).read();
  ASSERT_THAT(left.training, SizeIs(3));
  EXPECT_EQ(left.training[0].path, path("tea pot/000.pcd"));
  ASSERT_TRUE(left.training[0].plane);
  EXPECT_EQ(left.training[1].path, path("mug/000.pcd"));
  EXPECT_EQ(left.training[2].path, path("mug/002.pcd"));

  views_.removeLast("mug");
  EXPECT_THAT(linesWith(".pcd"), SizeIs(2));
}

TEST_F(CapturedViewsTest, MayAllBeDeletedByHand) {
  for (const char* none : {"name: captured\nunits: m\ntraining:\n", "name: captured\nunits: m\ntraining: []\n",
                           "name: captured\nunits: m\n"}) {
    views_.add("mug", view(1));
    test::writeFile(path("dataset.yaml"), none);
    EXPECT_THAT(views_.read().training, IsEmpty()) << none;
    EXPECT_THAT(views_.objects(), IsEmpty()) << none;
    EXPECT_EQ(views_.remove("mug"), 0u) << none;
    EXPECT_EQ(views_.add("mug", view(2)).views, 1u) << none;
    EXPECT_THAT(views_.read().training, SizeIs(1)) << none;
  }
}

TEST_F(CapturedViewsTest, TakeTheLastOneBack) {
  views_.add("mug", view(1));
  views_.add("cup", view(2));
  views_.add("mug", view(3));
  auto removed = views_.removeLast("mug");
  EXPECT_EQ(removed.file, path("mug/001.pcd"));
  EXPECT_EQ(removed.views, 1u);
  EXPECT_FALSE(fs::exists(path("mug/001.pcd")));
  EXPECT_THAT(views_.objects(), ElementsAre("mug", "cup"));
  EXPECT_EQ(views_.removeLast("mug").views, 0u);
  EXPECT_THAT(views_.objects(), ElementsAre("cup"));
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { views_.removeLast("mug"); }), HasSubstr("no view of 'mug'"));
  views_.removeLast("cup");
  EXPECT_THAT(views_.read().training, IsEmpty());
}

}  // namespace
}  // namespace sks
