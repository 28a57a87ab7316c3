// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/model_visual.hpp"

#include <vector>

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/point_cloud.h>

namespace sks_detector {
namespace {

constexpr float full = 255;      // of a channel
constexpr float coverage = 1.5;  // diameter of the points in spacings: no gaps, whichever way the surface turns

}  // namespace

ModelVisual::ModelVisual(Ogre::SceneManager& scene, Ogre::SceneNode& parent)
    : scene_(scene), node_(parent.createChildSceneNode()), points_(std::make_unique<rviz::PointCloud>()) {
  points_->setRenderMode(rviz::PointCloud::RM_SPHERES);
  node_->attachObject(points_.get());
}

ModelVisual::~ModelVisual() {
  node_->detachAllObjects();
  points_.reset();
  scene_.destroySceneNode(node_);
}

void ModelVisual::show(const std::shared_ptr<const ObjectCloud>& model, const Ogre::ColourValue& color,
                       bool own_colors) {
  if (model == model_ && color == color_ && own_colors == own_colors_) return;
  model_ = model;
  color_ = color;
  own_colors_ = own_colors;
  points_->clear();
  if (!model) return;
  const sks::Cloud& cloud = model->cloud;
  std::vector<rviz::PointCloud::Point> drawn(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    drawn[i].position = Ogre::Vector3(p.x(), p.y(), p.z());
    drawn[i].color = color;
    if (!own_colors || !cloud.hasColor()) continue;
    drawn[i].setColor(float(cloud.colors[i].r) / full, float(cloud.colors[i].g) / full,
                      float(cloud.colors[i].b) / full);
  }
  const float diameter = coverage * model->spacing;
  points_->setDimensions(diameter, diameter, diameter);
  points_->addPoints(drawn.data(), std::uint32_t(drawn.size()));
}

void ModelVisual::setPose(const Ogre::Vector3& position, const Ogre::Quaternion& orientation) {
  node_->setPosition(position);
  node_->setOrientation(orientation);
}

}  // namespace sks_detector
