// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/bag_info_text.hpp"

#include <map>
#include <set>

#include "core/settings/shown_text.hpp"
#include "ros/frame_name.hpp"
#include "tools/bag/stamps.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

using sks_detector::withoutSlash;

using nlohmann::json;

std::string yesOrNo(bool value) {
  return value ? "yes" : "no";
}

std::string framesText(const CloudCheck& cloud) {
  std::string text;
  for (const std::string& frame : cloud.frames())
    text += (text.empty() ? "" : ", ") + (frame.empty() ? "-" : shown(frame));
  return text.empty() ? "-" : text;
}

std::string topicTable(const BagFile& bag) {
  Table table({"<topic", "<type", "messages"});
  for (const BagTopic& topic : bag.topics()) table.add({topic.name, topic.type, std::to_string(topic.messages)});
  return table.text();
}

std::string cloudTable(const BagReport& report) {
  Table table({"<clouds", "usable", "size", "bytes", "colour", "NaN [%]", "Hz", "<fields", "<frame"});
  for (const CloudCheck& cloud : report.clouds) {
    table.add({cloud.topic(), std::to_string(cloud.usable()) + "/" + std::to_string(cloud.count()),
               std::to_string(cloud.width()) + " x " + std::to_string(cloud.height()),
               std::to_string(cloud.pointStep()), yesOrNo(cloud.colored()), fixed(100 * cloud.invalidShare(), 1),
               fixed(cloud.stamps().rate(), 1), cloud.fields(), framesText(cloud)});
  }
  return table.text();
}

/// The frames of the clouds with those above them, up to the root.
std::string frameLines(const BagReport& report) {
  const std::map<std::string, std::string> tree = report.transforms.tree();
  std::string text = "transforms: " + std::to_string(tree.size()) + " frames below ";
  for (const std::string& root : report.transforms.roots()) text += root + " ";
  text.back() = '\n';
  std::set<std::string> frames;
  for (const CloudCheck& cloud : report.clouds) frames.insert(cloud.frames().begin(), cloud.frames().end());
  for (const std::string& frame : frames) {
    std::string line = withoutSlash(frame);
    std::set<std::string> seen;
    for (auto link = tree.find(line); link != tree.end() && !link->second.empty() && seen.insert(link->first).second;
         link = tree.find(link->second)) {
      line += " < " + link->second;
    }
    text += "  " + shownMessage(line) + "\n";
  }
  return text;
}

json cloudJson(const CloudCheck& cloud) {
  return {{"topic", cloud.topic()},          {"messages", cloud.count()},
          {"usable", cloud.usable()},        {"width", cloud.width()},
          {"height", cloud.height()},        {"organized", cloud.organized()},
          {"color", cloud.colored()},        {"fields", cloud.fields()},
          {"point_step", cloud.pointStep()}, {"invalid_share", cloud.invalidShare()},
          {"rate", cloud.stamps().rate()},   {"frames", cloud.frames()}};
}

}  // namespace

std::string bagInfoText(const BagFile& bag, const BagReport& report) {
  std::string text = bag.path() + ": " + std::to_string(bag.messageCount()) + " messages in " +
                     fixed((report.end - report.begin).toSec(), 1) + " s from " + stampText(report.begin) + "\n\n" +
                     topicTable(bag);
  if (!report.clouds.empty()) text += "\n" + cloudTable(report);
  if (!report.transforms.tree().empty()) text += "\n" + frameLines(report);
  text += report.remarks.empty() ? "\nno remarks\n" : "\nremarks\n";
  for (const Remark& remark : report.remarks) {
    text += "  " + severityName(remark.severity) + ": " + shownMessage(remark.topic + ": " + remark.message) + "\n";
  }
  return text;
}

json bagInfoJson(const BagFile& bag, const BagReport& report) {
  json result{{"file", bag.path()},
              {"messages", bag.messageCount()},
              {"begin", report.begin.toSec()},
              {"end", report.end.toSec()},
              {"topics", json::array()},
              {"clouds", json::array()},
              {"camera_info", json::array()},
              {"detections", json::array()},
              {"frames", json::object()},
              {"remarks", json::array()},
              {"usable_topics", report.usableTopics()}};
  for (const BagTopic& topic : bag.topics()) {
    result["topics"].push_back({{"topic", topic.name}, {"type", topic.type}, {"messages", topic.messages}});
  }
  for (const CloudCheck& cloud : report.clouds) result["clouds"].push_back(cloudJson(cloud));
  for (const CameraInfoReport& camera : report.cameras) {
    result["camera_info"].push_back({{"topic", camera.topic},
                                     {"messages", camera.count},
                                     {"width", camera.width},
                                     {"height", camera.height},
                                     {"fx", camera.fx},
                                     {"frame", camera.frame}});
  }
  for (const DetectionsReport& detections : report.detections) {
    result["detections"].push_back({{"topic", detections.topic},
                                    {"arrays", detections.arrays},
                                    {"detections", detections.detections},
                                    {"with_cloud", detections.with_cloud}});
  }
  for (const auto& [frame, parent] : report.transforms.tree()) {
    result["frames"][frame] = parent.empty() ? json() : json(parent);
  }
  for (const Remark& remark : report.remarks) {
    result["remarks"].push_back(
        {{"severity", severityName(remark.severity)}, {"topic", remark.topic}, {"message", remark.message}});
  }
  return result;
}

}  // namespace sks::tools
