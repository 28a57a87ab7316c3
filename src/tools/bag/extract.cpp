// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include <sensor_msgs/PointCloud2.h>

#include <sks_detector/cloud_io.hpp>

#include "io/file.hpp"
#include "ros/cloud_message.hpp"
#include "tools/bag/commands.hpp"
#include "tools/bag/recorded_detections.hpp"
#include "tools/bag/stamps.hpp"
#include "tools/command.hpp"
#include "tools/data_set_yaml.hpp"
#include "tools/force_option.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

struct BagExtractOptions {
  std::string bag;
  std::string output;
  ForceOption force;
  std::string topic;
  std::string ground_truth;
  std::size_t every = 1;
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
};

/// A folder that is filled with clouds, and the data set file that lists them.
class ExtractedSet {
public:
  explicit ExtractedSet(const std::string& folder) : folder_(folder) { makeFolder((folder_ / "scenes").string()); }

  /// @param truth null where it is not known
  void add(const ros::Time& stamp, const Cloud& cloud, const RecordedArray* truth) {
    const std::string name = stampText(stamp);
    if (!names_.insert(name).second) {
      warn("a second cloud has the stamp " + name + ": the first was taken");
      return;
    }
    Scene scene = truth ? groundTruthScene(name, truth->detections) : Scene{name, "", {}, {}};
    scene.path = "scenes/" + name + ".pcd";
    writeCloud((folder_ / scene.path).string(), cloud);
    scenes_ += sceneYaml(scene);
  }

  std::size_t count() const { return names_.size(); }

  /// @throws Error(bad_data) where the bag's names cannot stand in a data set
  std::string finish(const std::string& name, const ForceOption& force) const {
    std::string path = (folder_ / "dataset.yaml").string();
    const std::string text =
        "# Clouds out of a bag, named by their stamps. Give each scene the objects that stand in "
        "it, and list what is to be trained.\nname: " +
        yamlText(name) + "\nunits: m\nmax_distance: 0.05\nscenes:\n" + scenes_;
    parseDataSet(text, path);  // what would be refused later, such as a name in the bag, is not left behind
    force.write(path, text);
    return path;
  }

private:
  fs::path folder_;
  std::set<std::string> names_;
  std::string scenes_;
};

/// Nothing, with a warning, where the message is no cloud.
std::optional<Cloud> usableCloud(const sensor_msgs::PointCloud2& message, const ros::Time& stamp) {
  try {
    return sks_detector::toCloud(message);
  } catch (const Error& error) {
    warn("the cloud at " + stampText(stamp) + " is left out: " + error.what());
    return std::nullopt;
  }
}

void checkRange(const BagExtractOptions& options) {
  if (options.every < 1) throw Error(ErrorCode::bad_usage, "--every 0: must be at least 1");
  if (!(options.from >= 0 && options.from < options.to)) {
    throw Error(ErrorCode::bad_usage, "--from and --to: need 0 <= from < to, in seconds from the bag's beginning");
  }
}

void run(const BagExtractOptions& options) {
  checkRange(options);
  const BagFile bag(options.bag);
  const std::string topic = findCloudTopic(bag, options.topic);
  const std::string truth_topic = findGroundTruthTopic(bag, options.ground_truth);
  const RecordedDetections truth = truth_topic.empty() ? RecordedDetections() : readDetections(bag, truth_topic);
  options.force.checkFolder(options.output);
  ExtractedSet set(options.output);
  ProgressBar bar;
  const Progress progress = bar.callback();
  std::size_t number = 0;
  const ros::Time begin = bag.timeRange().first;
  bag.forEach<sensor_msgs::PointCloud2>(topic, [&](const auto& message, const ros::Time& recorded) {
    const double second = (recorded - begin).toSec();
    if (second < options.from || second > options.to || number++ % options.every != 0) return;
    const ros::Time& stamp = message.header.stamp.isZero() ? recorded : message.header.stamp;
    report(progress, {"extracting", stampText(stamp), set.count(), 0});
    const auto array = truth.arrays.find(stamp);
    if (const std::optional<Cloud> cloud = usableCloud(message, stamp)) {
      set.add(stamp, *cloud, array == truth.arrays.end() ? nullptr : &array->second);
    }
  });
  bar.clear();
  if (set.count() == 0) {
    throw Error(ErrorCode::bad_data, "'" + options.bag + "': no cloud of " + topic + " can be taken in that time");
  }
  print(std::to_string(set.count()) + " clouds: " + set.finish(fs::path(options.bag).stem().string(), options.force) +
        "\n");
}

}  // namespace

void addBagExtract(CLI::App& bag) {
  CLI::App* command = bag.add_subcommand("extract", "cuts clouds out of a bag, as PCD files and a data set file");
  const auto options = std::make_shared<BagExtractOptions>();
  command->add_option("bag", options->bag, "bag file")->required()->type_name("FILE");
  command->add_option("--output,-o", options->output, "folder for dataset.yaml and scenes/")
      ->required()
      ->type_name("DIR");
  options->force.add(*command);
  command->add_option("--topic,-t", options->topic, "topic of the clouds (default: the only one)")->type_name("TOPIC");
  command->add_option("--ground-truth", options->ground_truth, "topic of the truth (default: the one called so)")
      ->type_name("TOPIC");
  command->add_option("--every", options->every, "only each N-th cloud (default: 1)")->type_name("N");
  command->add_option("--from", options->from, "seconds from the bag's beginning (default: 0)")->type_name("S");
  command->add_option("--to", options->to, "seconds from the bag's beginning (default: its end)")->type_name("S");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
