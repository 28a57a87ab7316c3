// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/Info.h>
#include <sks_detector/LoadCodebook.h>
#include <sks_detector/RemoveObject.h>
#include <sks_detector/SaveCodebook.h>

#include "ros/service_context.hpp"

namespace sks_detector {

/// `~load_codebook`, `~save_codebook`, `~remove_object` and `~info`. They throw what the caller is to reply.
class CodebookServices {
public:
  explicit CodebookServices(ServiceContext& context) : context_(context) {}

  void load(const LoadCodebook::Request& request, LoadCodebook::Response& response);
  void save(const SaveCodebook::Request& request, SaveCodebook::Response& response);
  void removeObject(const RemoveObject::Request& request, RemoveObject::Response& response);
  void info(const Info::Request& request, Info::Response& response);

private:
  /// A training would swap its codebook in over any other change.
  void refuseWhileTraining() const;

  ServiceContext& context_;
};

}  // namespace sks_detector
