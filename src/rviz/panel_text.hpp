// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/CaptureView.h>
#include <sks_detector/Info.h>
#include <sks_detector/Status.h>

namespace sks_detector {

/// What a node is doing, in words.
std::string describeState(const Status& status);

/// "toys (3f2a90c1): 3 objects, cshot", and its file where there is one; what to do where there is no codebook.
std::string describeCodebook(const InfoResponse& info);

/// What was captured of an object: "5 views, 62 % of the directions", and those that are missing.
std::string describeCaptured(const CaptureViewResponse& response);

}  // namespace sks_detector
