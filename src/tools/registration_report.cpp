// SPDX-License-Identifier: BSD-3-Clause
#include "tools/registration_report.hpp"

#include "core/settings/number_format.hpp"
#include "tools/detection_json.hpp"

namespace sks::tools {
namespace {

constexpr double degrees = 180 / EIGEN_PI;  // of a radian

nlohmann::json viewJson(const RegisteredView& view) {
  nlohmann::json json = {{"view", view.source}};
  if (view.T_model_view) {
    json["pose"] = poseJson(*view.T_model_view);
  } else {
    json["reason"] = view.reason;
  }
  return json;
}

}  // namespace

nlohmann::json registrationJson(const std::vector<RegisteredObject>& objects) {
  nlohmann::json list = nlohmann::json::array();
  for (const RegisteredObject& object : objects) {
    nlohmann::json json = {{"object", object.object},
                           {"frame", object.frame},
                           {"tied", object.tied()},
                           {"on_plane", object.on_plane},
                           {"points", object.model.points.size()}};
    json["box_min"] = object.model.box.isEmpty() ? nlohmann::json() : vectorJson(object.model.box.min().cast<double>());
    json["box_max"] = object.model.box.isEmpty() ? nlohmann::json() : vectorJson(object.model.box.max().cast<double>());
    json["loops"] = {{"count", object.loops.loops},
                     {"median_mm", 1000 * object.loops.median_shift},
                     {"max_mm", 1000 * object.loops.largest_shift},
                     {"median_deg", degrees * object.loops.median_angle},
                     {"max_deg", degrees * object.loops.largest_angle}};
    json["views"] = nlohmann::json::array();
    for (const RegisteredView& view : object.views) json["views"].push_back(viewJson(view));
    list.push_back(std::move(json));
  }
  return list;
}

std::string registrationText(const std::vector<RegisteredObject>& objects) {
  std::string text;
  for (const RegisteredObject& object : objects) {
    if (object.tied() == 0) continue;
    const Eigen::Vector3f size = 1000 * object.model.box.sizes();
    text += "registered '" + object.object + "': " + std::to_string(object.tied()) + " of " +
            std::to_string(object.views.size()) + " views, " +
            formatted("%.0f x %.0f x %.0f mm, %zu loops close to %.1f mm and %.1f degrees\n", double(size.x()),
                      double(size.y()), double(size.z()), object.loops.loops, 1000 * object.loops.largest_shift,
                      degrees * object.loops.largest_angle);
  }
  return text;
}

}  // namespace sks::tools
