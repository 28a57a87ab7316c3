// SPDX-License-Identifier: BSD-3-Clause
// Views of the model that captured views make.
#include "core/registration/model_views.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sks {
namespace {

/// A box of 6 x 8 x 10 cm whose sides are seen from cameras at the same height, 50 cm away.
RegisteredObject boxSeenFrom(const std::vector<double>& degrees) {
  RegisteredObject object;
  object.object = "carton";
  object.frame = "carton#model";
  const Eigen::Vector3f half(0.03f, 0.04f, 0.05f);
  constexpr float spacing = 0.0025f;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (float a = -half[u]; a <= half[u]; a += spacing) {
        for (float b = -half[v]; b <= half[v]; b += spacing) {
          Eigen::Vector3f p, n = Eigen::Vector3f::Zero();
          p[axis] = side * half[axis];
          p[u] = a;
          p[v] = b;
          n[axis] = side;
          object.model.points.push_back(p);
          object.model.normals.push_back(n);
          object.model.box.extend(p);
        }
      }
    }
  }
  for (const double turn : degrees) {
    RegisteredView view;
    view.T_model_view = Eigen::Translation3d(0, 0, -1) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX());
    const double angle = turn * EIGEN_PI / 180;
    view.sensor = 0.5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    object.views.push_back(view);
  }
  return object;
}

Cloud inModel(const TrainingSample& sample) {
  Cloud cloud = sample.load();
  const Eigen::Isometry3f T = sample.T_model_source.value().cast<float>();
  for (Eigen::Vector3f& p : cloud.points) p = T * p;
  cloud.sensor_origin = T * cloud.sensor_origin;
  return cloud;
}

TEST(ModelViewsTest, LieNearTheCameras) {
  const RegisteredObject object = boxSeenFrom({0, 90});
  const std::vector<TrainingSample> samples = modelSamples(object, {});
  ASSERT_GE(samples.size(), 2u);
  ASSERT_LE(samples.size(), 12u);
  for (const TrainingSample& sample : samples) {
    EXPECT_EQ(sample.object, "carton");
    EXPECT_EQ(sample.frame, "carton#model");
    EXPECT_EQ(sample.source.rfind("carton#model/", 0), 0u);
    ASSERT_TRUE(sample.box);
    EXPECT_EQ(sample.box->max(), object.model.box.max());
    const Eigen::Vector3d eye = inModel(sample).sensor_origin.cast<double>();
    EXPECT_NEAR(eye.norm(), 0.5, 1e-5);
    const double nearest = std::max(eye.normalized().x(), eye.normalized().y());
    EXPECT_GT(nearest, std::cos(25.1 * EIGEN_PI / 180));
  }
}

int sides(const Eigen::Vector3f& p) {
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) count += std::abs(std::abs(p[axis]) - 0.01f * float(3 + axis)) < 1e-5f;
  return count;
}

/// What faces away, or lies behind something, is not in sight; what a camera sees is whole.
TEST(ModelViewsTest, ShowWhatIsInSight) {
  RegisteredObject object = boxSeenFrom({0});
  const std::size_t box_points = object.model.points.size();
  for (float y = -0.01f; y <= 0.01f; y += 0.0025f) {  // a small plate before the side at +x, facing it
    for (float z = -0.01f; z <= 0.01f; z += 0.0025f) {
      object.model.points.emplace_back(0.08f, y, z);
      object.model.normals.emplace_back(Eigen::Vector3f::UnitX());
    }
  }
  ASSERT_GT(object.model.points.size(), box_points);
  for (const TrainingSample& sample : modelSamples(object, {})) {
    const Cloud cloud = inModel(sample);
    std::size_t on_side = 0, on_plate = 0;
    for (const Eigen::Vector3f& p : cloud.points) {
      const Eigen::Vector3f to_eye = cloud.sensor_origin - p;
      for (int axis = 0; axis < 3; ++axis) {  // points of the edges belong to two sides
        const bool on_plane = std::abs(std::abs(p[axis]) - 0.01f * float(3 + axis)) < 1e-5f;
        const bool on_one = on_plane && sides(p) == 1;
        EXPECT_TRUE(!on_one || p[axis] * to_eye[axis] > 0) << p.transpose();
      }
      on_plate += std::abs(p.x() - 0.08f) < 1e-5f;
      on_side += std::abs(p.x() - 0.03f) < 1e-5f;
      const Eigen::Vector3f ray = p - cloud.sensor_origin;
      const Eigen::Vector3f at_plate = cloud.sensor_origin + ray * (0.08f - cloud.sensor_origin.x()) / ray.x();
      const bool behind = p.x() < 0.079f && at_plate.tail<2>().cwiseAbs().maxCoeff() < 0.008f;
      EXPECT_FALSE(behind) << p.transpose();
    }
    EXPECT_EQ(on_plate, object.model.points.size() - box_points);
    EXPECT_GT(on_side, 1100u);  // of 33 x 41, 81 of which the plate hides and its border
  }
}

TEST(ModelViewsTest, OfNothingAreNone) {
  RegisteredObject object;
  object.object = "carton";
  EXPECT_TRUE(modelSamples(object, {}).empty());
}

}  // namespace
}  // namespace sks
