// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <OgreColourValue.h>
#include <OgrePrerequisites.h>
#include <rviz/ogre_helpers/ogre_vector.h>

#include "rviz/object_clouds.hpp"

namespace rviz {
class PointCloud;
}  // namespace rviz

namespace sks_detector {

/// The points of an object's model; its Ogre objects go with it. To be used in the thread that draws.
class ModelVisual {
public:
  ModelVisual(Ogre::SceneManager& scene, Ogre::SceneNode& parent);
  ~ModelVisual();
  ModelVisual(const ModelVisual&) = delete;
  ModelVisual& operator=(const ModelVisual&) = delete;

  /// @param model shown from now on; null: nothing
  /// @param color of all points
  /// @param own_colors those of the model instead, where it has some
  void show(const std::shared_ptr<const ObjectCloud>& model, const Ogre::ColourValue& color, bool own_colors);
  void setPose(const Ogre::Vector3& position, const Ogre::Quaternion& orientation);

private:
  Ogre::SceneManager& scene_;
  Ogre::SceneNode* node_;
  std::unique_ptr<rviz::PointCloud> points_;
  std::shared_ptr<const ObjectCloud> model_;  // that is shown
  Ogre::ColourValue color_;
  bool own_colors_ = false;
};

}  // namespace sks_detector
