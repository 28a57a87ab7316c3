// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/transform_check.hpp"

#include <algorithm>

#include "ros/frame_name.hpp"

namespace sks::tools {
namespace {

using sks_detector::withoutSlash;

constexpr char topic_name[] = "/tf";

template <typename Names>
std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

}  // namespace

void TransformCheck::add(const tf2_msgs::TFMessage& message, bool is_static) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    for (const std::string& frame : {transform.header.frame_id, transform.child_frame_id}) {
      if (withoutSlash(frame) != frame) slashed_.insert(frame);
    }
    const ros::Time& stamp = transform.header.stamp;
    Edge& edge = edges_[withoutSlash(transform.child_frame_id)][withoutSlash(transform.header.frame_id)];
    edge.is_static = edge.is_static || is_static;
    edge.first = edge.count == 0 ? stamp : std::min(edge.first, stamp);
    edge.last = std::max(edge.last, stamp);
    ++edge.count;
  }
}

std::string TransformCheck::parentOf(const std::string& frame) const {
  const auto child = edges_.find(frame);
  return child == edges_.end() ? "" : child->second.begin()->first;
}

bool TransformCheck::inLoop(const std::string& frame) const {
  std::string up = parentOf(frame);
  for (std::size_t i = 0; i < edges_.size() && !up.empty(); ++i) {
    if (up == frame) return true;
    up = parentOf(up);
  }
  return false;
}

std::map<std::string, std::string> TransformCheck::tree() const {
  std::map<std::string, std::string> tree;
  for (const auto& [child, parents] : edges_) {
    tree[child] = parents.begin()->first;
    for (const auto& parent : parents) tree.try_emplace(parent.first, parentOf(parent.first));
  }
  return tree;
}

std::vector<std::string> TransformCheck::roots() const {
  std::vector<std::string> roots;
  for (const auto& [frame, parent] : tree()) {
    if (parent.empty()) roots.push_back(frame);
  }
  return roots;
}

void TransformCheck::remark(Remarks& remarks) const {
  const auto add = [&](Severity severity, const std::string& message) {
    remarks.push_back({severity, topic_name, message});
  };
  if (edges_.empty()) {
    add(Severity::note, "there are no transforms: ~target_frame cannot be used");
    return;
  }
  if (!slashed_.empty()) {
    add(Severity::warning, "frames begin with a slash, which tf2 refuses: " + joined(slashed_));
  }
  std::set<std::string> loop;
  for (const auto& [child, parents] : edges_) {
    if (parents.size() > 1) {
      std::vector<std::string> names;
      for (const auto& parent : parents) names.push_back(parent.first);
      add(Severity::warning, "'" + child + "' has several parents, so that it jumps between them: " + joined(names));
    }
    if (inLoop(child)) loop.insert(child);
  }
  if (!loop.empty()) add(Severity::error, "frames are each other's parents: " + joined(loop));
  const std::vector<std::string> tops = roots();
  if (tops.size() > 1) add(Severity::warning, "the frames fall into several trees, with the roots " + joined(tops));
}

void TransformCheck::remarkOn(const std::string& topic, const std::string& frame, const std::vector<ros::Time>& stamps,
                              Remarks& remarks) const {
  if (edges_.empty() || frame.empty()) return;
  const auto add = [&](const std::string& message) { remarks.push_back({Severity::warning, topic, message}); };
  const std::string name = withoutSlash(frame);
  if (!tree().count(name)) {
    add("its frame '" + name + "' is not in /tf: ~target_frame cannot be used");
    return;
  }
  std::size_t worst = 0;
  std::string message;
  std::set<std::string> seen;
  for (std::string child = name; !parentOf(child).empty() && seen.insert(child).second; child = parentOf(child)) {
    const auto& [parent, edge] = *edges_.at(child).begin();
    if (edge.is_static) continue;
    const auto outside = [first = edge.first, last = edge.last](const ros::Time& t) { return t < first || t > last; };
    const auto count = std::size_t(std::count_if(stamps.begin(), stamps.end(), outside));
    if (count <= worst) continue;
    worst = count;
    message = shareText(count, stamps.size(), "clouds") + " lie outside of the time in which /tf has '" + parent +
              "' -> '" + child + "': ~target_frame would fail for them" +
              (edge.count == 1 ? "; it comes once, and what never changes belongs on /tf_static" : "");
  }
  if (worst > 0) add(message);
}

}  // namespace sks::tools
