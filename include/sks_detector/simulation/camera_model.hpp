// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace sks {

/// What goes wrong in a depth camera of structured light. Each part can be switched off.
///
/// Axial and lateral noise: C. V. Nguyen, S. Izadi, D. Lovell, "Modeling Kinect Sensor Noise for Improved 3D
/// Reconstruction and Tracking", 3DIMPVT 2012. Disparity steps: K. Khoshelham, S. O. Elberink, "Accuracy and Resolution
/// of Kinect Depth Data for Indoor Mapping Applications", Sensors 12(2), 2012; its errors of half a step agree with the
/// smooth errors of the presets (camera_presets.hpp).
struct CameraNoise {
  bool axial = true;              ///< depth errors of axialSigma()
  bool lateral = true;            ///< depth is that of a position lateral_sigma away in the image
  bool disparity = true;          ///< depth in steps of disparity_step
  bool shadow = true;             ///< no depth where the projector's light does not come
  bool grazing = true;            ///< no depth on surfaces that are seen at a slant
  double lateral_sigma = 0.8;     ///< [px]
  double disparity_step = 0.125;  ///< [px]
  double grazing_from = 70;       ///< angle between ray and normal from which on depth is lost now and then [deg]
  double grazing_to = 80;         ///< and from which on it is always lost [deg]
  std::uint64_t seed = 1;
  /// Smooth errors of the disparity, in place of axialSigma(); the lateral ones then move edges alone; 0: none [px]
  double disparity_sigma = 0;
  double correlation_x = 0, correlation_y = 0;  ///< of smooth errors: NoiseField::sigma_x, sigma_y [px]
  double depth_step = 0;                        ///< depths are multiples of it; 0: no steps [m]
  double edge_loss = 0;                         ///< no depth so near to an edge of what is in front [px]
  bool dark = false;                            ///< depth is lost in patches on what is nearly black

  static CameraNoise none() { return {false, false, false, false, false}; }
};

/// What a colour camera makes of true colours. Each picture draws its own exposure, white balance, light and offset.
/// All off by default.
struct ColorErrors {
  double min_exposure = 0, max_exposure = 0;  ///< brightness [stops]
  double min_red = 0, max_red = 0;            ///< white balance: red against green [stops]
  double min_blue = 0, max_blue = 0;          ///< blue against green [stops]
  double light = 0;                           ///< share of the light that comes from one direction and casts shadows
  double vignetting = 0;                      ///< share of the light that corners lack
  double blur = 0;                            ///< sigma of a Gaussian [px]
  double noise_red = 0, noise_green = 0, noise_blue = 0;  ///< sigma, of neighbouring pixels alike [levels of 255]
  double offset = 0;  ///< at most, in x and y, of the colours against the depths [px]

  bool any() const;
};

/// A pinhole RGB-D camera; by default a Kinect or Xtion at VGA. Its optical frame (REP 103): x right, y down, z
/// forward.
struct CameraModel {
  int width = 640;                        ///< [px]
  int height = 480;                       ///< [px]
  double fx = 525, fy = 525;              ///< focal lengths [px]
  double cx = 319.5, cy = 239.5;          ///< principal point [px]
  double min_range = 0.4, max_range = 4;  ///< depths outside are not measured [m]
  double baseline = 0.075;                ///< from the camera to the infrared projector, along x [m]
  bool shading = false;                   ///< colours darken with the angle between ray and normal
  CameraNoise noise;
  ColorErrors color;

  /// Direction of the ray through a position in the image, with z = 1.
  Eigen::Vector3f ray(double column, double row) const {
    return {float((column - cx) / fx), float((row - cy) / fy), 1.0f};
  }
};

/// Standard deviation of a Kinect's depth [m], disparity steps included (Nguyen et al., eq. 1 and 2).
/// @param depth [m] @param angle between ray and normal [rad]
double axialSigma(double depth, double angle);

/// The depth that is left of a true one in steps of disparity. @param depth [m]
double quantizeDepth(const CameraModel& camera, double depth);

/// Refuses what is no camera. @throws Error(bad_usage) naming the value and its range
void validate(const CameraModel& camera);

}  // namespace sks
