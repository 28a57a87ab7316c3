// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace sks {

/// Pose and motion of one object from measured poses. While the object stands, its poses are averaged, so that it does
/// not flicker; once it moves they are followed as they are, and the motion is carried on to the next cloud. Frames are
/// those of the caller: a reference in which things stand still, and the model. Deterministic; not thread-safe.
class PoseFilter {
public:
  PoseFilter() = default;
  /// @param center of the model's box, at which shifts are measured [m], model frame
  /// @param stamp [s]
  PoseFilter(const Eigen::Isometry3d& T_reference_model, const Eigen::Vector3d& center, double stamp);

  const Eigen::Isometry3d& pose() const { return T_reference_model_; }
  /// Whether the object has not moved for a while.
  bool stands() const { return stands_; }
  /// Where the object is to be looked for: where it stands, or where its motion takes it; the motion is carried on for
  /// a tenth of a second at most.
  Eigen::Isometry3d predicted(double stamp) const;

  /// @param noise of measured positions: standard deviation of depth where the object is [m]
  void update(const Eigen::Isometry3d& measured, double stamp, double noise);

  /// All that was measured moves with the camera.
  void carry(const Eigen::Isometry3d& motion);

private:
  void stand(const Eigen::Isometry3d& measured, double noise);
  void move(const Eigen::Isometry3d& measured, double seconds, double stamp, double noise);
  Eigen::Vector3d shift(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;

  Eigen::Isometry3d T_reference_model_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double stamp_ = 0;
  bool stands_ = true;
  int averaged_ = 1;                                          // poses in the mean
  Eigen::Vector3d drift_ = Eigen::Vector3d::Zero();           // mean of the last differences from the pose [m]
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();            // ... rotation vector [rad]
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();        // of the centre [m/s], reference frame
  Eigen::Vector3d turning_ = Eigen::Vector3d::Zero();         // rotation vector [rad/s], reference frame
  Eigen::Isometry3d anchor_ = Eigen::Isometry3d::Identity();  // while moving: a pose that it may have come to rest in
  double anchored_ = 0;                                       // since when [s]
};

}  // namespace sks
