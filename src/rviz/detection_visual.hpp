// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <OgreColourValue.h>
#include <OgrePrerequisites.h>
#include <rviz/ogre_helpers/ogre_vector.h>

#include "rviz/shown_detections.hpp"

namespace rviz {
class Axes;
class BillboardLine;
class DisplayContext;
class MovableText;
class Shape;
}  // namespace rviz

namespace sks_detector {

class DetectionSelection;
class ModelVisual;
struct ObjectCloud;

/// How detections are drawn.
struct DetectionStyle {
  enum class Axes { none, box, model };

  float alpha = 0;          ///< of the faces of boxes; 0: only their edges
  Axes axes = Axes::box;    ///< where the axes of the model are drawn
  bool labels = true;       ///< name and score above the box
  float label_height = 0;   ///< of the picture's height
  bool own_colors = false;  ///< of models, where they have some
};

/// The eye that labels turn to, in the frame of the detections.
struct LabelView {
  Ogre::Vector3 eye;
  Ogre::Vector3 up;
  bool orthographic = false;
  float height = 0;  ///< of what is seen [m]: at 1 m from the eye, or anywhere where the view is orthographic
};

/// The box or model, axes and label of one detection; its Ogre objects go with it. To be used in the thread that draws.
class DetectionVisual {
public:
  /// @param node of the frame of the detections
  DetectionVisual(rviz::DisplayContext& context, Ogre::SceneNode& node);
  ~DetectionVisual();
  DetectionVisual(const DetectionVisual&) = delete;
  DetectionVisual& operator=(const DetectionVisual&) = delete;

  /// @param message the detection as it came, for the Selection panel
  /// @param model to be shown in place of the box; null: the box
  void show(const ShownDetection& shown, const Detection& message, const std::shared_ptr<const ObjectCloud>& model,
            const Ogre::ColourValue& color, const DetectionStyle& style);
  /// Puts the label above the box as the eye sees it, in front of what stands in the box, in a size that can be read.
  void turnLabel(const LabelView& view, const DetectionStyle& style);

private:
  void drawLabel(const std::string& text, const Ogre::ColourValue& color, bool visible);
  /// The faces are there even where they cannot be seen: they are what is selected.
  void drawBox(bool with_edges, const Ogre::ColourValue& color, float alpha);
  void drawEdges(const Ogre::Vector3& size, const Ogre::ColourValue& color);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode* node_;         // of the frame of the detections
  Ogre::SceneNode* label_node_;   // not turned with the box
  Ogre::SceneNode* shadow_node_;  // at the same place: to Ogre all texts have one name, which is unique at a node
  std::unique_ptr<rviz::BillboardLine> edges_;
  std::unique_ptr<rviz::Shape> faces_;
  std::unique_ptr<rviz::Axes> axes_;
  std::unique_ptr<rviz::MovableText> label_;
  std::unique_ptr<rviz::MovableText> shadow_;  // of the label, which can be read before any background
  std::unique_ptr<DetectionSelection> selection_;
  std::unique_ptr<ModelVisual> model_;
  Eigen::Isometry3d T_scene_box_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d box_size_ = Eigen::Vector3d::Zero();
};

}  // namespace sks_detector
