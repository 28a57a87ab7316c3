// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/cloud_check.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/pipeline/scene_description.hpp"
#include "core/settings/shown_text.hpp"
#include "ros/cloud_message.hpp"
#include "ros/frame_name.hpp"
#include "ros/node_settings.hpp"

namespace sks::tools {
namespace {

using sks_detector::withoutSlash;

constexpr std::size_t longest_field = 60, longest_list = 400;  // [bytes]

std::string fieldNames(const sensor_msgs::PointCloud2& message) {
  std::string names;
  for (std::size_t i = 0; i < message.fields.size() && names.size() < longest_list; ++i) {
    names += (names.empty() ? "" : " ") + shown(message.fields[i].name, longest_field);
  }
  return names;
}

std::string quoted(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + shown(name) + "'";
  return text;
}

}  // namespace

void CloudCheck::add(const sensor_msgs::PointCloud2& message, const ros::Time& recorded) {
  if (count() > 0 && (message.height > 1 || organized()) && (message.width != width_ || message.height != height_)) {
    ++resized_;
  }
  stamps_.add(message.header.stamp, recorded);
  frames_.insert(message.header.frame_id);
  width_ = message.width;
  height_ = message.height;
  point_step_ = message.point_step;
  fields_ = fieldNames(message);
  try {
    const Cloud cloud = sks_detector::receivedCloud(message, sks_detector::NodeSettings().max_points);
    if (!cloud.hasColor()) ++uncolored_;
    const auto invalid = std::size_t(std::count_if(cloud.points.begin(), cloud.points.end(),
                                                   [](const Eigen::Vector3f& point) { return !point.allFinite(); }));
    points_ += cloud.size();
    invalid_ += invalid;
    if (message.is_dense && invalid > 0) ++wrongly_dense_;
    usablePoints(cloud, Orientation::sensor, Settings());
    ++usable_;
  } catch (const Error& error) {
    ++refusals_[error.what()];
  }
}

double CloudCheck::invalidShare() const {
  return points_ == 0 ? 0 : double(invalid_) / double(points_);
}

void CloudCheck::remark(Remarks& remarks) const {
  const auto add = [&](Severity severity, const std::string& message) {
    remarks.push_back({severity, topic_, message});
  };
  for (const auto& [message, clouds] : refusals_) {
    add(Severity::error, shareText(clouds, count(), "clouds") + " would be refused: " + message);
  }
  if (count() == 0) {
    add(Severity::error, "there are no clouds on it");
    return;
  }
  if (frames_.count("")) add(Severity::error, "the header has no frame_id: set it to the camera's optical frame");
  if (frames_.size() > 1) add(Severity::warning, "the clouds are in different frames: " + quoted(frames_));
  for (const std::string& frame : frames_) {
    if (withoutSlash(frame) != frame) {
      add(Severity::note,
          "the frame '" + shown(frame) + "' begins with a slash, which tf2 does not know: the node drops it");
    }
  }
  if (uncolored_ > 0 && usable_ > 0) {
    add(Severity::warning,
        "there is no colour: a codebook with CSHOT descriptors is refused; train one with "
        "descriptor.type=shot");
  }
  if (usable_ > 0 && !organized()) {
    add(Severity::note, "the clouds are not organised: normals take longer; a cloud as the camera gives it is better");
  }
  if (resized_ > 0) add(Severity::note, "the size of the images changes " + std::to_string(resized_) + " times");
  if (wrongly_dense_ > 0) {
    add(Severity::note,
        shareText(wrongly_dense_, count(), "clouds") + " say is_dense and hold NaN: this node copes, others may crash");
  }
  stamps_.remark(topic_, remarks);
}

}  // namespace sks::tools
