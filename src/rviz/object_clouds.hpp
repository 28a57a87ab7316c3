// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <sks_detector/Detection.h>
#include <sks_detector/ObjectModels.h>

#include <sks_detector/cloud.hpp>

namespace sks_detector {

/// The surface of an object in one of its model frames.
struct ObjectCloud {
  sks::Cloud cloud;   ///< finite points [m], model frame; with or without colours
  float spacing = 0;  ///< of the points [m]
};

/// The models that a node's ~models tells of.
class ObjectClouds {
public:
  /// Replaces what is known; never throws for what is in a message: models that make no sense are left out.
  void set(const ObjectModels& message);
  void forget();

  bool known() const { return known_; }
  const std::string& codebook() const { return codebook_; }
  std::size_t size() const { return clouds_.size(); }
  /// The first model that makes no sense, in words; empty: none.
  const std::string& problem() const { return problem_; }
  /// In the frame of the detection's pose; null where it is not known.
  std::shared_ptr<const ObjectCloud> find(const Detection& detection) const;

private:
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const ObjectCloud>> clouds_;  // by object and view
  std::string codebook_;
  std::string problem_;
  bool known_ = false;
};

}  // namespace sks_detector
