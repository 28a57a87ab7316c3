// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/object_colors.hpp"

#include <algorithm>

#include "drawing/palette.hpp"

namespace sks_detector {

bool ObjectColors::setCodebook(const std::vector<std::string>& objects) {
  if (known_ && objects == objects_) return false;
  objects_ = objects;
  known_ = true;
  return true;
}

void ObjectColors::forget() {
  objects_.clear();
  known_ = false;
}

Ogre::ColourValue ObjectColors::color(const std::string& object) {
  constexpr float full = 255;
  const sks::Rgb color = sks::objectColor(objects_, object);
  // beyond the palette colours repeat: more names would only be searched in vain
  if (!known_ && objects_.size() < sks::palette_size &&
      std::find(objects_.begin(), objects_.end(), object) == objects_.end()) {
    objects_.push_back(object);
  }
  return Ogre::ColourValue(float(color.r) / full, float(color.g) / full, float(color.b) / full);
}

Ogre::ColourValue scoreColor(double score) {
  const double s = score > 0 ? std::min(score, 1.0) : 0.0;
  return Ogre::ColourValue(float(std::min(1.0, 2 - 2 * s)), float(std::min(1.0, 2 * s)), 0);
}

}  // namespace sks_detector
