// SPDX-License-Identifier: BSD-3-Clause
//
// Records what a virtual camera sees of an object on a table: record_table PICTURES.json FILE.bag
//
// PICTURES is a list of {"object": mesh, "degrees": direction of the camera, "elevation": in degrees, "distance": in m,
// "table": whether there is one, "lift": height of the object above it in m, "arm": whether somebody holds the object}.
// The truth of a picture is the frame that the model has where this is its first view: z up, x to the camera, origin on
// the table below the middle of the object's box.
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/camera_presets.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "table_scene.hpp"
#include "tools/bag.hpp"

namespace sks {
namespace {

using nlohmann::json;

/// The model's pose and box. @param T_table_mesh of the object
Detection truthOf(const std::string& object, const Mesh& mesh, const Eigen::Isometry3d& T_table_mesh, double degrees,
                  const Eigen::Isometry3d& T_table_camera) {
  const Eigen::Isometry3d T_table_turned = test::turnedBy(degrees);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& p : mesh.vertices) box.extend(T_table_turned.inverse() * T_table_mesh * p.cast<double>());
  const Eigen::Isometry3d T_camera_turned = T_table_camera.inverse() * T_table_turned;
  Detection truth;
  truth.object = object;
  truth.view = "table";
  truth.score = 1;
  truth.T_scene_model = T_camera_turned * Eigen::Translation3d(box.center().x(), box.center().y(), 0);
  truth.T_scene_box = T_camera_turned * Eigen::Translation3d(box.center());
  truth.box_size = box.sizes();
  return truth;
}

void record(const json& picture, const CameraModel& camera, std::uint64_t number, tools::BagRecorder& bag) {
  const std::string object = picture.at("object");
  const double degrees = picture.at("degrees"), elevation = picture.at("elevation");
  const auto mesh = std::make_shared<const Mesh>(findMesh(object).mesh);
  Renderer renderer;
  if (picture.value("table", true)) test::addTable(renderer);
  const Eigen::Translation3d lifted(0, 0, picture.value("lift", 0.0));
  if (picture.value("arm", false)) {
    const Eigen::Translation3d to_object(0, -0.03, 0);  // the hand touches it
    test::addForearm(renderer, lifted * test::turnedBy(degrees) * to_object);
  }
  const Eigen::Isometry3d T_table_mesh = lifted * test::standingPose(*mesh);
  renderer.addInstance(renderer.addMesh(mesh), T_table_mesh);
  const Eigen::Vector3d target(0, 0, 0.5 * double(mesh->box().sizes().z()));
  const Eigen::Isometry3d T_table_camera =
      test::cameraAt(target, degrees, elevation * EIGEN_PI / 180, picture.at("distance"));
  bag.add(renderer.render(camera, T_table_camera, number, 2).cloud, T_table_camera,
          {truthOf(object, *mesh, T_table_mesh, degrees, T_table_camera)});
}

}  // namespace
}  // namespace sks

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const nlohmann::json pictures = nlohmann::json::parse(std::ifstream(argv[1]));
    const sks::CameraModel camera = sks::cameraPreset("kinect");
    sks::tools::BagRecorder bag(argv[2], camera, 1);
    std::uint64_t number = 0;
    for (const nlohmann::json& picture : pictures) sks::record(picture, camera, number++, bag);
    bag.finish();
  } catch (const std::exception& error) {
    std::cerr << "record_table: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
