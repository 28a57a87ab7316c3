// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include <sks_detector/DetectionArray.h>
#include <sks_detector/ObjectModels.h>
#include <sks_detector/Status.h>
#ifndef Q_MOC_RUN
#include <rviz/message_filter_display.h>

#include "rviz/detection_visual.hpp"
#include "rviz/object_clouds.hpp"
#include "rviz/object_colors.hpp"
#endif

namespace rviz {
class BoolProperty;
class EnumProperty;
class FloatProperty;
class IntProperty;
}  // namespace rviz

namespace sks_detector {

/// rviz display of a sks_detector/DetectionArray: boxes or models, labels and axes, which can be selected. Of arrays
/// that come faster than rviz draws only the newest is drawn. What cannot be drawn is told in the display's status.
class DetectionsDisplay : public rviz::MessageFilterDisplay<DetectionArray> {
  Q_OBJECT
public:
  DetectionsDisplay();
  ~DetectionsDisplay() override;

  void reset() override;
  void update(float wall_dt, float ros_dt) override;

protected:
  void onInitialize() override;
  void subscribe() override;
  void unsubscribe() override;

private Q_SLOTS:
  void styleChanged();
  void shapeChanged();

private:
  void processMessage(const DetectionArray::ConstPtr& message) override;
  /// Of every array, also of those that wait for their transform.
  void noteArrival(const DetectionArray::ConstPtr& message);
  void tellWaiting();
  void receiveStatus(const Status::ConstPtr& status);
  void receiveModels(const ObjectModels::ConstPtr& models);
  /// Listens to the node's models while they are wanted: they may be large.
  void listenToModels();
  /// Makes the Ogre objects those of the current array; false where its frame cannot be transformed.
  bool draw();
  Ogre::ColourValue colorOf(const Detection& detection);
  void tellColors();
  /// @param missing a detection without a model; null: none
  void tellModels(const Detection* missing);
  void tellChoice(const ShownDetections& chosen);
  void turnLabels();

  rviz::FloatProperty* threshold_;
  rviz::EnumProperty* shape_;
  rviz::EnumProperty* color_;
  rviz::FloatProperty* alpha_;
  rviz::EnumProperty* axes_;
  rviz::BoolProperty* labels_;
  rviz::FloatProperty* label_size_;
  rviz::FloatProperty* timeout_;
  rviz::IntProperty* most_;

  DetectionArray::ConstPtr array_;
  ros::WallTime received_;
  DetectionArray::ConstPtr waiting_;  // the first of those that came after what is drawn
  ros::WallTime waiting_since_;
  bool changed_ = false;  // since the last drawing
  ObjectColors colors_;
  DetectionStyle style_;
  std::map<std::string, std::unique_ptr<DetectionVisual>> visuals_;
  ros::Subscriber status_;
  std::string status_topic_;
  ros::Subscriber models_;
  std::string models_topic_;
  ObjectClouds clouds_;
};

}  // namespace sks_detector
