// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/selection/selection_handler.h>
#include <sks_detector/Detection.h>

namespace sks_detector {

/// Shows the fields of a selected detection in rviz's Selection panel, and follows what comes in.
class DetectionSelection : public rviz::SelectionHandler {
public:
  explicit DetectionSelection(rviz::DisplayContext& context) : rviz::SelectionHandler(&context) {}

  void show(const Detection& message) { message_ = message; }

  void createProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void updateProperties() override;

private:
  Detection message_;
};

}  // namespace sks_detector
