// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/detection_selection.hpp"

#include <rviz/properties/property.h>
#include <rviz/properties/quaternion_property.h>
#include <rviz/properties/vector_property.h>

#include "core/settings/shown_text.hpp"

namespace sks_detector {
namespace {

Ogre::Vector3 fieldVector(double x, double y, double z) {
  return {float(x), float(y), float(z)};
}

Ogre::Quaternion fieldQuaternion(const geometry_msgs::Quaternion& q) {
  return {float(q.w), float(q.x), float(q.y), float(q.z)};
}

QString textOf(const std::string& text) {
  return QString::fromStdString(sks::shown(text));
}

/// The property of a name below `group`, made where there is none yet.
template <typename Kind>
Kind* child(rviz::Property* group, const char* name) {
  for (int i = 0; i < group->numChildren(); ++i) {
    if (group->childAt(i)->getName() == name) return qobject_cast<Kind*>(group->childAt(i));
  }
  auto* property = new Kind(name);
  property->setReadOnly(true);
  group->addChild(property);
  return property;
}

void setValue(rviz::Property* group, const char* name, const QVariant& value) {
  child<rviz::Property>(group, name)->setValue(value);
}

void setPose(rviz::Property* group, const char* position, const char* orientation, const geometry_msgs::Pose& pose) {
  child<rviz::VectorProperty>(group, position)
      ->setVector(fieldVector(pose.position.x, pose.position.y, pose.position.z));
  child<rviz::QuaternionProperty>(group, orientation)->setQuaternion(fieldQuaternion(pose.orientation));
}

}  // namespace

void DetectionSelection::createProperties(const rviz::Picked& /*picked*/, rviz::Property* parent) {
  properties_.push_back(new rviz::Property("Detection", QVariant(), "", parent));
  updateProperties();
  properties_.back()->expand();
}

void DetectionSelection::updateProperties() {
  for (rviz::Property* group : properties_) {
    group->setValue(textOf(message_.object));
    setValue(group, "score", double(message_.score));
    setPose(group, "pose position", "pose orientation", message_.pose.pose);
    setPose(group, "box_center position", "box_center orientation", message_.box_center);
    child<rviz::VectorProperty>(group, "box_size")
        ->setVector(fieldVector(message_.box_size.x, message_.box_size.y, message_.box_size.z));
    setValue(group, "votes", message_.votes);
    setValue(group, "inliers", message_.inliers);
    setValue(group, "view", textOf(message_.view));
    setValue(group, "id", message_.id);
    setValue(group, "tracked", bool(message_.tracked));
  }
}

}  // namespace sks_detector
