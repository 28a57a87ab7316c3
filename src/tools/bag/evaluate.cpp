// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sensor_msgs/PointCloud2.h>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/settings.hpp>

#include "ros/cloud_message.hpp"
#include "tools/bag/commands.hpp"
#include "tools/bag/recorded_evaluation.hpp"
#include "tools/command.hpp"
#include "tools/evaluation_json.hpp"
#include "tools/evaluation_plots.hpp"
#include "tools/evaluation_table.hpp"
#include "tools/progress_bar.hpp"

namespace sks::tools {
namespace {

struct BagEvaluateOptions {
  std::string bag;
  std::string data_set;
  std::string detections;
  std::string ground_truth;
  std::string symmetries;
  std::string topic;
  double max_distance = 0.05;
  double threshold = Settings().detection.threshold;
  bool count_unanswered = false;
  JsonOption json;
  std::string plot;
};

/// Stamps of the clouds, with the times at which they were recorded.
std::map<ros::Time, ros::Time> cloudStamps(const BagFile& bag, const std::string& topic) {
  std::map<ros::Time, ros::Time> stamps;
  bag.forEach<sensor_msgs::PointCloud2>(
      topic, [&](const auto& message, const ros::Time& recorded) { stamps.emplace(message.header.stamp, recorded); });
  return stamps;
}

/// Stamps of the clouds where there are some, else of the detections.
std::vector<ros::Time> stampsOf(const BagFile& bag, const BagEvaluateOptions& options,
                                const RecordedDetections& found) {
  std::vector<ros::Time> stamps;
  if (!options.topic.empty() || !bag.topicsOf("sensor_msgs/PointCloud2").empty()) {
    for (const auto& [stamp, recorded] : cloudStamps(bag, findCloudTopic(bag, options.topic))) stamps.push_back(stamp);
  } else {
    for (const auto& [stamp, array] : found.arrays) stamps.push_back(stamp);
  }
  return stamps;
}

RecordedTruth findTruth(const BagFile& bag, const BagEvaluateOptions& options, const std::string& ground_truth,
                        const RecordedDetections& found) {
  if (!options.data_set.empty()) {
    const DataSet data_set = loadDataSet(options.data_set);
    for (const std::string& warning : data_set.warnings) warn(warning);
    return truthFromDataSet(data_set, stampsOf(bag, options, found));
  }
  if (ground_truth.empty()) {
    throw Error(ErrorCode::bad_data, "'" + options.bag +
                                         "' has no topic of ground truth (sks_detector/DetectionArray, "
                                         "called ground_truth): name it with --ground-truth, or give --dataset FILE");
  }
  RecordedTruth truth = truthFromArrays(options.bag, readDetections(bag, ground_truth), found, options.max_distance);
  if (!options.symmetries.empty()) addSymmetries(loadDataSet(options.symmetries), truth);
  return truth;
}

/// The clouds of the scenes that were scored, from the bag.
SceneClouds cloudsFromBag(const BagFile& bag, const std::string& topic, const RecordedEvaluation& recorded) {
  return [&bag, topic, &recorded, times = cloudStamps(bag, topic)](std::size_t scene) {
    const ros::Time stamp = recorded.stamps[scene];
    const auto time = times.find(stamp);
    Cloud cloud;
    if (time == times.end()) return cloud;
    bag.forEach<sensor_msgs::PointCloud2>(topic, time->second, time->second, [&](const auto& message, const auto&) {
      if (message.header.stamp == stamp) cloud = sks_detector::toCloud(message);
    });
    return cloud;
  };
}

void run(const BagEvaluateOptions& options) {
  const BagFile bag(options.bag);
  options.json.check();
  const std::string clouds = options.plot.empty() ? "" : findCloudTopic(bag, options.topic);
  if (!options.plot.empty()) preparePlots(options.plot);
  const std::string ground_truth = findGroundTruthTopic(bag, options.ground_truth);
  const std::string detections = findDetectionsTopic(bag, options.detections, ground_truth);
  if (detections.empty()) {
    throw Error(ErrorCode::bad_data, "'" + options.bag +
                                         "' has no recorded detections (sks_detector/DetectionArray): "
                                         "record ~detections of the node together with the clouds");
  }
  const RecordedDetections found = readDetections(bag, detections);
  const RecordedTruth truth = findTruth(bag, options, ground_truth, found);
  const RecordedEvaluation recorded = evaluateRecorded(truth, found, options.threshold, options.count_unanswered);
  for (const std::string& warning : recorded.warnings) warn(warning);
  if (found.repeated > 0) {
    warn(std::to_string(found.repeated) + " arrays of " + detections + " repeat a stamp: the first of each counts");
  }
  if (recorded.unanswered > 0) {
    warn(std::to_string(recorded.unanswered) +
         " clouds with ground truth have no detections, as when the node drops "
         "frames: they " +
         (options.count_unanswered ? "count as missed" : "are left out (--count-unanswered)"));
  }
  nlohmann::json json = recordedJson(recorded.evaluation);
  json["unanswered"] = recorded.unanswered;
  options.json.write(json);
  if (!options.json.onStdout()) print(recordedTable(recorded.evaluation));
  if (options.plot.empty()) return;
  ProgressBar bar;
  writePlots(options.plot, cloudsFromBag(bag, clouds, recorded), recorded.evaluation, json, bar.callback());
}

}  // namespace

void addBagEvaluate(CLI::App& bag) {
  CLI::App* command = bag.add_subcommand(
      "evaluate", "scores recorded detections against the ground truth in the bag or in a data set file");
  const auto options = std::make_shared<BagEvaluateOptions>();
  command->add_option("bag", options->bag, "bag file")->required()->type_name("FILE");
  CLI::Option* data_set = command
                              ->add_option("--dataset,-d", options->data_set,
                                           "data set file with the ground truth (default: the ground truth in the bag)")
                              ->type_name("FILE");
  command->add_option("--detections", options->detections, "topic of the detections (default: the only one)")
      ->type_name("TOPIC");
  command->add_option("--ground-truth", options->ground_truth, "topic of the truth (default: the one called so)")
      ->type_name("TOPIC")
      ->excludes(data_set);
  command
      ->add_option("--symmetries", options->symmetries,
                   "data set file whose training entries tell how the objects in the bag's ground truth are symmetric")
      ->type_name("FILE")
      ->excludes(data_set);
  command->add_option("--topic,-t", options->topic, "topic of the clouds (default: the only one)")->type_name("TOPIC");
  command
      ->add_option("--max-distance", options->max_distance,
                   "farthest that a true positive lies from its ground truth [m] (default: 0.05)")
      ->check(CLI::PositiveNumber)
      ->excludes(data_set);
  command->add_option("--threshold", options->threshold, "lowest score that counts (default: 0.5)")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--count-unanswered", options->count_unanswered, "clouds without detections count as missed");
  options->json.add(*command);
  command->add_option("--plot", options->plot, "draw precision-recall curves, thresholds, times and each scene")
      ->type_name("DIR");
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
