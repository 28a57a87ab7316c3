// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <OgreColourValue.h>

namespace sks_detector {

/// The colours that objects have in markers and pictures too: by their place in the codebook, as the node's ~status
/// tells it. Without a status, as where only ~detections was recorded, by the order in which they appear.
class ObjectColors {
public:
  /// Objects in the order of the codebook; @return whether that is new
  bool setCodebook(const std::vector<std::string>& objects);
  /// No status is known any more: objects count in the order in which they appear.
  void forget();
  bool known() const { return known_; }

  Ogre::ColourValue color(const std::string& object);

private:
  std::vector<std::string> objects_;
  bool known_ = false;
};

/// From red (0) by yellow to green (1). @param score outside of [0, 1] and NaN count as the nearer end
Ogre::ColourValue scoreColor(double score);

}  // namespace sks_detector
