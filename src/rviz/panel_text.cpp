// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/panel_text.hpp"

#include "core/settings/number_format.hpp"

namespace sks_detector {

std::string describeState(const Status& status) {
  switch (status.state) {
    case Status::NO_CODEBOOK:
      return "no codebook: nothing can be found until one is trained or loaded";
    case Status::READY:
      return "ready: waits for clouds, or for somebody who wants results";
    case Status::DETECTING:
      return "detecting";
    case Status::DISABLED:
      return "disabled by its service ~enable";
    case Status::TRAINING:
      return "training";
    case Status::FAILING:
      return "failing: the last cloud could not be used";
    default:
      return "in a state that this panel does not know: " + std::to_string(status.state);
  }
}

std::string describeCodebook(const InfoResponse& info) {
  if (info.codebook.empty()) return "none";
  const std::size_t count = info.objects.size();
  std::string text = info.codebook + sks::formatted(": %zu object%s", count, count == 1 ? "" : "s");
  if (!info.descriptor.empty()) text += ", " + info.descriptor;
  return text + (info.codebook_file.empty() ? ", not saved" : ", " + info.codebook_file);
}

std::string describeCaptured(const CaptureViewResponse& response) {
  const std::string views = sks::formatted("%u view%s", response.views, response.views == 1 ? "" : "s");
  return views + sks::formatted(", %.0f %%", 100 * response.coverage);
}

}  // namespace sks_detector
