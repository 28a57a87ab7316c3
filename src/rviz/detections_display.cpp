// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/detections_display.hpp"

#include <utility>

#include <OgreCamera.h>
#include <OgreSceneNode.h>
#include <ros/names.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <pluginlib/class_list_macros.hpp>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"

namespace sks_detector {
namespace {

using rviz::StatusProperty;

constexpr const char* default_topic = "/detector/detections";
constexpr int as_box = 0, as_model = 1;                   // the options of "Shape"
constexpr int by_object = 0, by_score = 1, by_model = 2;  // the options of "Color By"
constexpr double transform_patience = 0.5;                // [s] for which a transform may be late without a word
constexpr int most_at_once = 10000;                       // boxes; more would stop the window for seconds

}  // namespace

DetectionsDisplay::DetectionsDisplay() {
  const char* changed = SLOT(styleChanged());
  threshold_ = new rviz::FloatProperty("Threshold", 0, "Lowest score of what is shown, 0 to 1.", this, changed);
  threshold_->setMin(0);
  threshold_->setMax(1);
  shape_ = new rviz::EnumProperty("Shape", "Box",
                                  "Box, or Model: the surface that was trained, as the node's ~models tells it; where "
                                  "it is not known, the box.",
                                  this, SLOT(shapeChanged()));
  shape_->addOption("Box", as_box);
  shape_->addOption("Model", as_model);
  color_ = new rviz::EnumProperty("Color By", "Object",
                                  "Object: the colour that the object has in markers and pictures too; "
                                  "Score: from red (0) to green (1); Model: models have the colours that were trained, "
                                  "all else that of its object.",
                                  this, changed);
  color_->addOption("Object", by_object);
  color_->addOption("Score", by_score);
  color_->addOption("Model", by_model);
  alpha_ = new rviz::FloatProperty("Alpha", 0.15F, "Of the faces of the boxes, 0 to 1; 0: only edges.", this, changed);
  alpha_->setMin(0);
  alpha_->setMax(1);
  axes_ = new rviz::EnumProperty("Axes", "Box",
                                 "Axes of the model: at the centre of the box, or at the origin of the model's frame, "
                                 "which for an object trained from a camera's views may lie outside of the object.",
                                 this, changed);
  axes_->addOption("None", int(DetectionStyle::Axes::none));
  axes_->addOption("Box", int(DetectionStyle::Axes::box));
  axes_->addOption("Model", int(DetectionStyle::Axes::model));
  labels_ = new rviz::BoolProperty("Labels", true, "Name and score above the box.", this, changed);
  label_size_ =
      new rviz::FloatProperty("Label Size", 0.035F, "Height of the labels as a share of the view's.", this, changed);
  label_size_->setMin(0.005F);
  label_size_->setMax(0.5F);
  timeout_ = new rviz::FloatProperty("Timeout", 10, "Boxes go when no array came for so long [s]; 0: never.", this);
  timeout_->setMin(0);
  most_ = new rviz::IntProperty("Most Shown", 200, "Most boxes at once: those with the highest scores.", this, changed);
  most_->setMin(1);
  most_->setMax(most_at_once);
}

DetectionsDisplay::~DetectionsDisplay() = default;

void DetectionsDisplay::onInitialize() {
  MFDClass::onInitialize();
  sub_.registerCallback(&DetectionsDisplay::noteArrival, this);
  topic_property_->setValue(default_topic);
  styleChanged();
}

void DetectionsDisplay::reset() {
  MFDClass::reset();
  array_.reset();
  waiting_.reset();
  visuals_.clear();
}

void DetectionsDisplay::subscribe() {
  MFDClass::subscribe();
  if (!isEnabled()) return;
  try {
    const std::string topic = update_nh_.resolveName(topic_property_->getTopicStd());
    const std::string node = ros::names::parentNamespace(topic);
    models_topic_ = ros::names::append(node, "models");
    status_topic_ = ros::names::append(node, "status");
    status_ = update_nh_.subscribe(status_topic_, 1, &DetectionsDisplay::receiveStatus, this);
  } catch (const ros::Exception&) {  // the name of the topic is wrong, as its status says
    status_topic_.clear();
    models_topic_.clear();
  }
  listenToModels();
  tellColors();
}

void DetectionsDisplay::unsubscribe() {
  MFDClass::unsubscribe();
  status_.shutdown();
  models_.shutdown();
  colors_.forget();
  clouds_.forget();
}

void DetectionsDisplay::listenToModels() {
  const bool wanted = isEnabled() && shape_->getOptionInt() == as_model && !models_topic_.empty();
  if (wanted && !models_) {
    models_ = update_nh_.subscribe(models_topic_, 1, &DetectionsDisplay::receiveModels, this);
    tellModels(nullptr);
  } else if (!wanted) {
    models_.shutdown();
    clouds_.forget();
    deleteStatus("Models");
  }
}

void DetectionsDisplay::noteArrival(const DetectionArray::ConstPtr& message) {
  if (waiting_) return;
  waiting_ = message;
  waiting_since_ = ros::WallTime::now();
}

void DetectionsDisplay::tellWaiting() {
  if (!waiting_ || (ros::WallTime::now() - waiting_since_).toSec() < transform_patience) return;
  const std_msgs::Header header = waiting_->header;
  waiting_.reset();
  std::string problem;
  if (!context_->getFrameManager()->transformHasProblems(header.frame_id, header.stamp, problem)) return;
  setStatusStd(StatusProperty::Error, "Transform", problem);
}

void DetectionsDisplay::processMessage(const DetectionArray::ConstPtr& message) {
  waiting_.reset();
  array_ = message;
  received_ = ros::WallTime::now();
  changed_ = true;
}

void DetectionsDisplay::receiveStatus(const Status::ConstPtr& status) {
  if (!colors_.setCodebook(status->objects)) return;
  tellColors();
  changed_ = true;
}

void DetectionsDisplay::receiveModels(const ObjectModels::ConstPtr& models) {
  clouds_.set(*models);
  tellModels(nullptr);
  changed_ = true;
}

void DetectionsDisplay::styleChanged() {
  style_.alpha = alpha_->getFloat();
  style_.axes = DetectionStyle::Axes(axes_->getOptionInt());
  style_.labels = labels_->getBool();
  style_.label_height = label_size_->getFloat();
  style_.own_colors = color_->getOptionInt() == by_model;
  changed_ = true;
}

void DetectionsDisplay::shapeChanged() {
  listenToModels();
  changed_ = true;
}

void DetectionsDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  const double timeout = double(timeout_->getFloat());
  if (array_ && timeout > 0 && (ros::WallTime::now() - received_).toSec() > timeout) {
    array_.reset();
    visuals_.clear();
    setStatus(StatusProperty::Warn, "Detections",
              QString("None came for %1 s: is the node running, and do clouds come?").arg(timeout));
  }
  tellWaiting();
  if (array_ && changed_) changed_ = !draw();
  if (!visuals_.empty()) turnLabels();
}

bool DetectionsDisplay::draw() {
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  rviz::FrameManager& frames = *context_->getFrameManager();
  const std_msgs::Header& header = array_->header;
  if (!frames.getTransform(header, position, orientation)) {
    std::string problem;
    if (!frames.transformHasProblems(header.frame_id, header.stamp, problem)) problem = "not known yet";
    setStatusStd(StatusProperty::Error, "Transform", problem);
    visuals_.clear();
    return false;
  }
  setStatus(StatusProperty::Ok, "Transform", "OK");
  scene_node_->setPosition(position);
  scene_node_->setOrientation(orientation);

  const ShownDetections chosen = chooseShown(*array_, double(threshold_->getFloat()), std::size_t(most_->getInt()));
  const bool models = shape_->getOptionInt() == as_model;
  const Detection* missing = nullptr;
  std::map<std::string, std::unique_ptr<DetectionVisual>> visuals;
  for (const ShownDetection& shown : chosen.shown) {
    std::unique_ptr<DetectionVisual>& visual = visuals[shown.key];
    const auto old = visuals_.find(shown.key);
    if (!visual && old != visuals_.end()) visual = std::move(old->second);
    if (!visual) visual = std::make_unique<DetectionVisual>(*context_, *scene_node_);
    const Detection& message = array_->detections[shown.index];
    const std::shared_ptr<const ObjectCloud> model = models ? clouds_.find(message) : nullptr;
    if (models && !model && missing == nullptr) missing = &message;
    visual->show(shown, message, model, colorOf(message), style_);
  }
  visuals_ = std::move(visuals);
  tellChoice(chosen);
  tellColors();
  if (models) tellModels(missing);
  context_->queueRender();
  return true;
}

void DetectionsDisplay::tellChoice(const ShownDetections& chosen) {
  std::string text = sks::formatted("%zu of %zu shown", chosen.shown.size(), array_->detections.size());
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += sks::formatted("; %zu %s", count, what);
  };
  add(chosen.below_threshold, "below the threshold");
  add(chosen.too_many, "more than \"Most Shown\"");
  add(chosen.unusable, "cannot be drawn");
  add(chosen.unnormalized, "with quaternions whose length is not 1");
  if (!chosen.problem.empty()) text += "; " + chosen.problem;
  const bool fine = chosen.too_many == 0 && chosen.problem.empty();
  setStatusStd(fine ? StatusProperty::Ok : StatusProperty::Warn, "Detections", text);
}

Ogre::ColourValue DetectionsDisplay::colorOf(const Detection& detection) {
  const bool by_its_score = color_->getOptionInt() == by_score;
  return by_its_score ? scoreColor(double(detection.score)) : colors_.color(detection.object);
}

void DetectionsDisplay::tellModels(const Detection* missing) {
  if (!clouds_.known()) {
    setStatusStd(StatusProperty::Warn, "Models", "boxes are drawn, as nothing came on " + models_topic_);
    return;
  }
  std::string text = sks::formatted("%zu of %s", clouds_.size(), sks::shown(clouds_.codebook()).c_str());
  if (missing != nullptr) {
    text += "; none of '" + sks::shown(missing->object) + "' in the frame '" + sks::shown(missing->view) +
            "': its box is drawn";
  }
  if (!clouds_.problem().empty()) text += "; " + clouds_.problem();
  const bool fine = missing == nullptr && clouds_.problem().empty();
  setStatusStd(fine ? StatusProperty::Ok : StatusProperty::Warn, "Models", text);
}

void DetectionsDisplay::tellColors() {
  setStatusStd(StatusProperty::Ok, "Colors",
               colors_.known() ? "in the order of the codebook"
                               : "in the order in which objects appear, as nothing came on " + status_topic_);
}

void DetectionsDisplay::turnLabels() {
  const rviz::ViewController* controller = context_->getViewManager()->getCurrent();
  const Ogre::Camera* camera = controller ? controller->getCamera() : nullptr;
  if (!camera) return;
  const Ogre::Quaternion to_frame = scene_node_->_getDerivedOrientation().Inverse();
  const Ogre::Matrix4& projection = camera->getProjectionMatrix();
  LabelView view;
  view.eye = to_frame * (camera->getDerivedPosition() - scene_node_->_getDerivedPosition());
  view.up = to_frame * camera->getDerivedUp();
  view.orthographic = camera->getProjectionType() == Ogre::PT_ORTHOGRAPHIC;
  view.height = 2 / projection[1][1];
  for (const auto& [key, visual] : visuals_) visual->turnLabel(view, style_);
}

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::DetectionsDisplay, rviz::Display)
