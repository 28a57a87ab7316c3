// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/simulation/camera_model.hpp>
#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// What the virtual camera sees. All images are row-major, `cloud.width` x `cloud.height`.
struct Rendering {
  Cloud cloud;                         ///< organised, coloured where something was hit; camera's optical frame
  std::vector<std::int32_t> instance;  ///< what each pixel's ray meets first, -1 for nothing; free of noise

  /// Depth along z [m] of each pixel, NaN where there is none.
  std::vector<float> depth() const;
};

/// Casts rays at meshes with Embree. Meshes are shared by their instances.
class Renderer {
public:
  Renderer();
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// @return its number, for addInstance()
  std::size_t addMesh(std::shared_ptr<const Mesh> mesh);
  /// Places a mesh in the world. @param lost share of its surface that gives no depth, in patches, as glass and polish
  /// do @return number of the instance: Rendering::instance
  std::size_t addInstance(std::size_t mesh, const Eigen::Isometry3d& T_world_mesh, double lost = 0);
  std::size_t instanceCount() const;
  /// Places an instance anew.
  void moveInstance(std::size_t instance, const Eigen::Isometry3d& T_world_mesh);
  /// Hides an instance, or shows it again.
  void setVisible(std::size_t instance, bool visible);

  /// What a camera sees from a position. Same arguments, same bytes, for any number of threads.
  /// @param frame number of the picture: with the seed it chooses the noise
  /// @throws Error(bad_usage) for an impossible camera
  Rendering render(const CameraModel& camera, const Eigen::Isometry3d& T_world_camera, std::uint64_t frame,
                   int threads) const {
    return render(camera, T_world_camera, frame, frame, threads);
  }
  /// @param colors the same for pictures of one exposure, white balance, light and registration of colours
  Rendering render(const CameraModel& camera, const Eigen::Isometry3d& T_world_camera, std::uint64_t frame,
                   std::uint64_t colors, int threads) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sks
