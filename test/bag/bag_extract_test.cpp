// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "io/dataset.hpp"
#include "made_up_bag.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::at;
using test::CommandRun;
using ::testing::HasSubstr;

/// A bag of five clouds, a second apart, of which the first has ground truth and the last is no cloud.
class BagExtract : public ::testing::Test {
protected:
  void SetUp() override {
    rosbag::Bag bag(folder_.path("test.bag"), rosbag::bagmode::Write);
    for (int second = 0; second < 5; ++second) {
      sensor_msgs::PointCloud2 message = test::wallMessage(second);
      if (second == 4) message.fields.clear();
      bag.write("/points", at(second), message);
    }
    bag.write("/ground_truth", at(0),
              test::detections(0, {test::detection("mug", 0.1, 0.75), test::detection("duck", 0.2, 0.01)}));
  }

  CommandRun extract(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"bag", "extract", folder_.path("test.bag"), "--output", folder_.path("out")});
    return test::runSks(more);
  }
  DataSet dataSet() const { return loadDataSet(folder_.path("out/dataset.yaml")); }

  test::TemporaryFolder folder_;
};

TEST_F(BagExtract, WritesCloudsAndTheirTruth) {
  const CommandRun run = extract();
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("4 clouds: " + folder_.path("out/dataset.yaml")));
  EXPECT_THAT(run.errors, HasSubstr("the cloud at 1600000004.000000000 is left out: there is no field 'x'"));
  const DataSet data_set = dataSet();
  ASSERT_EQ(data_set.scenes.size(), 4u);
  const Scene& first = data_set.scenes[0];
  EXPECT_EQ(first.name, "1600000000.000000000");
  ASSERT_EQ(first.objects.size(), 1u);
  EXPECT_EQ(first.objects[0].object, "mug");
  EXPECT_NEAR(first.objects[0].position.x(), 0.1, 1e-9);
  EXPECT_EQ(first.objects[0].visibility, 0.75);
  EXPECT_EQ(first.objects[0].reference, "mug.obj");
  EXPECT_NEAR(first.objects[0].T_scene_reference->translation().x(), 0.1, 1e-9);
  EXPECT_EQ(first.ignore, std::vector<std::string>{"duck"});
  EXPECT_TRUE(data_set.scenes[1].objects.empty());

  const Cloud cloud = readCloud(first.path), truth = test::wall();
  EXPECT_EQ(cloud.width, truth.width);
  ASSERT_EQ(cloud.size(), truth.size());
  EXPECT_TRUE(cloud.points[3].hasNaN());
  EXPECT_EQ(cloud.points[100], truth.points[100]);
  EXPECT_EQ(cloud.colors[100].r, 200);
}

TEST_F(BagExtract, MixesNoTwoDataSets) {
  ASSERT_EQ(extract().status, 0);
  const CommandRun refused = extract({"--every", "2"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("holds a data set already"));
  EXPECT_EQ(dataSet().scenes.size(), 4u);
  ASSERT_EQ(extract({"--every", "2", "--force"}).status, 0);
  EXPECT_EQ(dataSet().scenes.size(), 2u);
}

TEST_F(BagExtract, TakesOnlyWhatIsAskedFor) {
  ASSERT_EQ(extract({"--from", "0.5", "--to", "3", "--every", "2"}).status, 0);
  const DataSet data_set = dataSet();
  ASSERT_EQ(data_set.scenes.size(), 2u);
  EXPECT_EQ(data_set.scenes[0].name, "1600000001.000000000");
  EXPECT_EQ(data_set.scenes[1].name, "1600000003.000000000");
}

TEST_F(BagExtract, RefusesWithTheReason) {
  const auto refusal = [&](const std::vector<std::string>& more, int status) {
    const CommandRun run = extract(more);
    EXPECT_EQ(run.status, status);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out/dataset.yaml")));
    return run.errors;
  };
  EXPECT_THAT(refusal({"--topic", "/nothing"}, 1), HasSubstr("no topic '/nothing' of type sensor_msgs/PointCloud2; it "
                                                             "has /points"));
  EXPECT_THAT(refusal({"--ground-truth", "truth"}, 1), HasSubstr("it has /ground_truth"));
  EXPECT_THAT(refusal({"--from", "10"}, 1), HasSubstr("no cloud of /points can be taken in that time"));
  EXPECT_THAT(refusal({"--from", "3", "--to", "2"}, 2), HasSubstr("need 0 <= from < to"));
  EXPECT_THAT(refusal({"--every", "0"}, 2), HasSubstr("--every 0"));
}

}  // namespace
}  // namespace sks

#endif
