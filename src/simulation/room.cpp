// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/room.hpp"

#include <cmath>
#include <memory>

#include <sks_detector/error.hpp>

#include "simulation/distractors.hpp"
#include "simulation/prints.hpp"
#include "simulation/scene_random.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

constexpr double floor_height = -0.72;                    // of a table [m]
constexpr float room_cell = 0.02f, wall_cell = 0.05f;     // between vertices, which carry the colours [m]
constexpr std::uint64_t room_stream = ~std::uint64_t(2);  // of random numbers
constexpr std::uint64_t table_stream = ~std::uint64_t(3);

/// Puts furniture into a room whose x axis points away from the camera, from the middle of the table.
class Furnisher {
public:
  Furnisher(Renderer& renderer, double away, PixelRandom& random)
      : renderer_(renderer), T_table_room_(Eigen::AngleAxisd(away, Eigen::Vector3d::UnitZ())), random_(random) {}

  void ground() {
    box({4, 0, floor_height - 0.05}, 0, {10, 10, 0.1f}, groundPattern(random_), wall_cell);
    const double back = number(1.2, 3.2), turn = number(-0.35, 0.35);
    box({back + 0.5, 0, 0.5}, turn, {0.1f, 10, 3}, plain(anyColor(random_, 120, 240)), 1);
    box({back, number(-0.3, 0.3) > 0 ? 2.2 : -2.2, 0.5}, 0, {8, 0.1f, 3}, plain(anyColor(random_, 120, 240)), 1);
  }

  void chair() {
    const Rgb color = anyColor(random_, 10, 200);
    const double x = number(0.9, 2), y = number(-1.1, 1.1), turn = number(0, 2 * EIGEN_PI), seat = -0.27;
    const Eigen::Isometry3d pose = Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
    part(pose, {0, 0, seat}, {0.45f, 0.45f, 0.05f}, plain(color));
    part(pose, {-0.2, 0, seat + 0.35}, {0.04f, 0.42f, 0.35f}, plain(color));
    for (const double a : {-0.2, 0.2}) {
      for (const double b : {-0.2, 0.2}) {
        part(pose, {a, b, 0.5 * (floor_height + seat)}, {0.03f, 0.03f, float(seat - floor_height)},
             plain({40, 40, 45}));
      }
    }
  }

  /// A desk with screens, which give no depth in places, and a box under it.
  void desk() {
    const double x = number(1.3, 2.2), y = number(-0.8, 0.8), turn = number(-0.5, 0.5);
    const Eigen::Isometry3d pose = Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
    part(pose, {0, 0, 0}, {0.7f, 1.4f, 0.03f}, groundPattern(random_));
    part(pose, {0.2, -0.5, -0.36}, {0.5f, 0.4f, 0.7f}, plain(anyColor(random_, 30, 230)));
    for (const double side : {-0.3, 0.35}) {
      const auto screen = [](const Eigen::Vector3f& p) -> Rgb {
        return p.x() < 0 && std::abs(p.y()) < 0.23f && std::abs(p.z()) < 0.13f ? Rgb{40, 60, 110} : Rgb{20, 20, 22};
      };
      part(pose, {0.05, side, 0.27}, {0.04f, 0.5f, 0.3f}, screen, number(0.3, 0.9));
      part(pose, {0.07, side, 0.07}, {0.05f, 0.08f, 0.12f}, plain({25, 25, 28}));
    }
  }

  /// Boards between two sides, with packages on them.
  void shelf() {
    const double x = number(1.1, 2.6), y = number(-1.2, 1.2), turn = number(-0.5, 0.5);
    const Eigen::Isometry3d pose = Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
    const Rgb wood = anyColor(random_, 60, 230);
    for (const double side : {-0.45, 0.45}) {
      part(pose, {0.15, side, 0.1}, {0.3f, 0.02f, 1.64f}, plain(wood));
    }
    part(pose, {0.3, 0, 0.1}, {0.01f, 0.9f, 1.64f}, plain(wood));
    for (const double height : {-0.4, -0.05, 0.3, 0.65}) {
      part(pose, {0.15, 0, height}, {0.3f, 0.9f, 0.02f}, plain(wood));
      for (double along = -0.36; along < 0.4; along += number(0.1, 0.25)) {
        const Mesh thing = packageDistractor(random_);
        const Eigen::AlignedBox3f bounds = thing.box();
        place(thing, pose * Eigen::Translation3d(0.1, along, height + 0.01 - double(bounds.min().z())), 0);
      }
    }
  }

private:
  double number(double low, double high) { return between(random_, low, high); }
  void place(Mesh mesh, const Eigen::Isometry3d& T_room_mesh, double lost) {
    renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(std::move(mesh))), T_table_room_ * T_room_mesh,
                          lost);
  }
  void part(const Eigen::Isometry3d& pose, const Eigen::Vector3d& at, const Eigen::Vector3f& size, const Paint& paint,
            double lost = 0) {
    place(makeBox(size, paint, room_cell), pose * Eigen::Translation3d(at), lost);
  }
  void box(const Eigen::Vector3d& at, double turn, const Eigen::Vector3f& size, const Paint& paint, float cell) {
    place(makeBox(size, paint, cell), Eigen::Translation3d(at) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()), 0);
  }

  Renderer& renderer_;
  Eigen::Isometry3d T_table_room_;
  PixelRandom& random_;
};

}  // namespace

std::vector<std::string> roomNames() {
  return {"none", "plain", "furnished"};
}

Room roomOf(const std::string& name) {
  if (name == "none") return Room::none;
  if (name == "plain") return Room::plain;
  if (name == "furnished") return Room::furnished;
  throw Error(ErrorCode::bad_usage, "there is no room '" + name + "': use one of none, plain, furnished");
}

void furnish(Renderer& renderer, const Eigen::Isometry3d& T_table_camera, std::uint64_t seed, std::uint64_t number) {
  PixelRandom random(seed, number, room_stream);
  const Eigen::Vector3d eye = T_table_camera.translation();
  Furnisher furnisher(renderer, std::atan2(-eye.y(), -eye.x()), random);
  furnisher.ground();
  const std::size_t chairs = below(random, 3);
  for (std::size_t i = 0; i < chairs; ++i) furnisher.chair();
  if (random.uniform() < 0.6) furnisher.desk();
  if (random.uniform() < 0.6) furnisher.shelf();
}

Mesh patternedTable(std::uint64_t seed, std::uint64_t number) {
  PixelRandom random(seed, number, table_stream);
  constexpr float thickness = 0.03f;
  return movedTo(makeBox({float(2 * table_half), float(2 * table_half), thickness}, groundPattern(random), 0.006f), 0,
                 0, -0.5f * thickness);
}

}  // namespace sks
