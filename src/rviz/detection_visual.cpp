// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/detection_visual.hpp"

#include <algorithm>

#include <OgreRenderQueue.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/ogre_helpers/axes.h>
#include <rviz/ogre_helpers/billboard_line.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/ogre_helpers/shape.h>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "rviz/detection_selection.hpp"
#include "rviz/model_visual.hpp"

namespace sks_detector {
namespace {

constexpr int edge_count = 12;                            // of a box
constexpr float thinnest_face = 1e-4F;                    // [m] a box without volume is seen all the same
constexpr float edge_width = 0.015F;                      // of the longest side, as in the markers
constexpr float thinnest_edge = 0.002F;                   // [m]
constexpr float axis_length = 0.6F, axis_radius = 0.02F;  // of the longest side, of the axis
constexpr float thinnest_axis = 0.001F;                   // [m]
constexpr float shadow_offset = 0.05F;                    // of a label's height
constexpr std::size_t longest_label = 60;                 // bytes

Ogre::Vector3 vectorOf(const Eigen::Vector3d& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

Ogre::Quaternion turnOf(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {float(q.w()), float(q.x()), float(q.y()), float(q.z())};
}

Eigen::Vector3d toEigen(const Ogre::Vector3& v) {
  return {double(v.x), double(v.y), double(v.z)};
}

}  // namespace

DetectionVisual::DetectionVisual(rviz::DisplayContext& context, Ogre::SceneNode& node)
    : scene_(*context.getSceneManager()),
      node_(node.createChildSceneNode()),
      label_node_(node_->createChildSceneNode()),
      shadow_node_(label_node_->createChildSceneNode()),
      edges_(std::make_unique<rviz::BillboardLine>(&scene_, node_)),
      faces_(std::make_unique<rviz::Shape>(rviz::Shape::Cube, &scene_, node_)),
      axes_(std::make_unique<rviz::Axes>(&scene_, node_)),
      selection_(std::make_unique<DetectionSelection>(context)),
      model_(std::make_unique<ModelVisual>(scene_, *node_)) {
  edges_->setNumLines(edge_count);
  edges_->setMaxPointsPerLine(2);
  selection_->addTrackedObjects(faces_->getRootNode());
}

DetectionVisual::~DetectionVisual() {
  model_.reset();
  selection_.reset();  // while what it watches is there
  for (Ogre::SceneNode* node : {shadow_node_, label_node_}) node->detachAllObjects();
  label_.reset();
  shadow_.reset();
  axes_.reset();
  faces_.reset();
  edges_.reset();
  for (Ogre::SceneNode* node : {shadow_node_, label_node_, node_}) scene_.destroySceneNode(node);
}

void DetectionVisual::show(const ShownDetection& shown, const Detection& message,
                           const std::shared_ptr<const ObjectCloud>& model, const Ogre::ColourValue& color,
                           const DetectionStyle& style) {
  T_scene_box_ = shown.detection.T_scene_box;
  box_size_ = shown.detection.box_size;
  drawBox(!model, color, model ? 0 : style.alpha);

  const Eigen::Isometry3d& T_scene_model = shown.detection.T_scene_model;
  const Ogre::Vector3 model_origin = vectorOf(T_scene_model.translation());
  const Ogre::Quaternion model_turn = turnOf(T_scene_model.linear());
  model_->show(model, color, style.own_colors);
  model_->setPose(model_origin, model_turn);

  axes_->setPosition(style.axes == DetectionStyle::Axes::model ? model_origin : vectorOf(T_scene_box_.translation()));
  axes_->setOrientation(model_turn);
  const float length = std::max(axis_length * float(box_size_.maxCoeff()), thinnest_face);
  axes_->set(length, std::max(thinnest_axis, axis_radius * length));
  axes_->getSceneNode()->setVisible(style.axes != DetectionStyle::Axes::none);

  drawLabel(sks::shown(shown.detection.object, longest_label) + sks::formatted(" %.2f", shown.detection.score), color,
            style.labels);
  selection_->show(message);
}

void DetectionVisual::drawLabel(const std::string& text, const Ogre::ColourValue& color, bool visible) {
  if (!label_) {
    for (std::unique_ptr<rviz::MovableText>* part : {&shadow_, &label_}) {
      *part = std::make_unique<rviz::MovableText>(text);
      (*part)->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
    }
    label_node_->attachObject(label_.get());
    shadow_node_->attachObject(shadow_.get());
    shadow_->setColor(Ogre::ColourValue::Black);
    label_->setRenderQueueGroup(Ogre::RENDER_QUEUE_MAIN + 1);  // after its shadow
  }
  label_->setColor(color);
  for (rviz::MovableText* part : {shadow_.get(), label_.get()}) {
    part->setCaption(text);
    part->setVisible(visible);
  }
}

void DetectionVisual::drawBox(bool with_edges, const Ogre::ColourValue& color, float alpha) {
  const Ogre::Vector3 center = vectorOf(T_scene_box_.translation());
  const Ogre::Quaternion turn = turnOf(T_scene_box_.linear());
  Ogre::Vector3 size = vectorOf(box_size_);
  edges_->clear();
  edges_->setPosition(center);
  edges_->setOrientation(turn);
  if (with_edges) drawEdges(size, color);
  size.makeCeil(Ogre::Vector3(thinnest_face));
  faces_->setPosition(center);
  faces_->setOrientation(turn);
  faces_->setScale(size);
  faces_->setColor(color.r, color.g, color.b, alpha);
}

void DetectionVisual::drawEdges(const Ogre::Vector3& size, const Ogre::ColourValue& color) {
  edges_->setLineWidth(std::max(thinnest_edge, edge_width * std::max({size.x, size.y, size.z})));
  bool first = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {  // the four edges along each axis
    for (const float u : {-0.5F, 0.5F}) {
      for (const float v : {-0.5F, 0.5F}) {
        if (!first) edges_->newLine();
        first = false;
        Ogre::Vector3 corner = 0.5F * size;
        corner[(axis + 1) % 3] = u * size[(axis + 1) % 3];
        corner[(axis + 2) % 3] = v * size[(axis + 2) % 3];
        edges_->addPoint(corner, color);
        corner[axis] *= -1;
        edges_->addPoint(corner, color);
      }
    }
  }
}

void DetectionVisual::turnLabel(const LabelView& view, const DetectionStyle& style) {
  const Eigen::Vector3d center = T_scene_box_.translation(), up = toEigen(view.up);
  const auto reach = [&](const Eigen::Vector3d& direction) {  // half the extent of the box
    return 0.5 * (T_scene_box_.linear().transpose() * direction).cwiseAbs().dot(box_size_);
  };
  const Eigen::Vector3d to_eye = toEigen(view.eye) - center;
  const double distance = to_eye.norm();
  if (!(distance > double(thinnest_face))) return;  // the eye is in the middle of the box
  const double height = double(style.label_height * view.height) * (view.orthographic ? 1 : distance);
  const Eigen::Vector3d toward = to_eye / distance;
  const double forward = std::min(reach(toward), 0.5 * distance);
  label_node_->setPosition(vectorOf(center + (reach(up) + 0.5 * height) * up + forward * toward));
  label_node_->setScale(Ogre::Vector3(float(height)));
  const float offset = shadow_offset * float(height);
  if (shadow_) shadow_->setLocalTranslation(Ogre::Vector3(offset, -offset, 0));
}

}  // namespace sks_detector
