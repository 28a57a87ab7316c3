// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>

#include <sks_detector/error.hpp>

#include "simulation/color_errors.hpp"
#include "simulation/depth_errors.hpp"
#include "simulation/pixel_random.hpp"

namespace sks {
namespace {

constexpr float far = 1000;        // rays end there [m]
constexpr float detach = 0.0005f;  // a shadow ray ends this far before the surface that it is about [m]
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// What a ray meets first.
struct Hit {
  bool found = false;
  float depth = 0;  // along z, for rays of z = 1
  unsigned instance = 0, triangle = 0;
  float u = 0, v = 0;                                 // barycentric
  float cosine = 1;                                   // of the angle between ray and normal
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  // towards the camera, in the world
};

/// From the first to the last pixel.
Eigen::AlignedBox2i wholePicture(const CameraModel& camera) {
  return {Eigen::Vector2i::Zero(), Eigen::Vector2i(camera.width - 1, camera.height - 1)};
}

Eigen::Matrix<float, 3, 4> toEmbree(const Eigen::Isometry3d& transform) {
  return transform.matrix().topRows<3>().cast<float>();
}

}  // namespace

struct Renderer::Impl {
  struct Instance {
    std::size_t mesh;
    RTCGeometry geometry;
    Eigen::Matrix3f R_world_mesh;
    double lost;
  };

  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene world = rtcNewScene(device);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<RTCScene> mesh_scenes;
  std::vector<Instance> instances;

  Impl() { rtcSetSceneFlags(world, RTC_SCENE_FLAG_ROBUST); }
  ~Impl() {
    for (const Instance& instance : instances) rtcReleaseGeometry(instance.geometry);
    for (const RTCScene scene : mesh_scenes) rtcReleaseScene(scene);
    rtcReleaseScene(world);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  bool blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;
  Rgb colorOf(const Hit& hit, const CameraModel& camera) const;
  Eigen::Vector3f lightOf(const Hit& hit, const Eigen::Vector3f& point, const CameraModel& camera,
                          const Eigen::Vector3f& to_light) const;
  /// The pixels whose rays can meet anything; empty if there is none.
  Eigen::AlignedBox2i window(const CameraModel& camera, const Eigen::Isometry3d& T_world_camera) const;
};

Hit Renderer::Impl::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  RTCRayHit query{};
  query.ray = {origin.x(), origin.y(), origin.z(), 0, direction.x(), direction.y(), direction.z(), 0, far, ~0u, 0, 0};
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(world, &context, &query);
  Hit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.found = true;
  hit.depth = query.ray.tfar;
  hit.instance = query.hit.instID[0];
  hit.triangle = query.hit.primID;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  const Eigen::Vector3f normal =
      instances[hit.instance].R_world_mesh * Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  const float cosine = normal.normalized().dot(direction.normalized());
  hit.cosine = std::min(1.0f, std::abs(cosine));  // whichever side is seen
  hit.normal = (cosine > 0 ? -1.0f : 1.0f) * normal.normalized();
  return hit;
}

bool Renderer::Impl::blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  const Eigen::Vector3f way = to - from;
  const float length = way.norm();
  RTCRay ray{from.x(), from.y(), from.z(), 0, way.x(), way.y(), way.z(), 0, 1 - detach / length, ~0u, 0, 0};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(world, &context, &ray);
  return ray.tfar < 0;  // Embree's sign that something was hit
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

std::size_t Renderer::addMesh(std::shared_ptr<const Mesh> mesh) {
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh->vertices.size()));
  for (const Eigen::Vector3f& v : mesh->vertices) vertices = std::copy(v.data(), v.data() + 3, vertices);
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh->triangles.size()));
  for (const Eigen::Vector3i& t : mesh->triangles) corners = std::copy(t.data(), t.data() + 3, corners);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  impl_->mesh_scenes.push_back(scene);
  impl_->meshes.push_back(std::move(mesh));
  return impl_->meshes.size() - 1;
}

std::size_t Renderer::addInstance(std::size_t mesh, const Eigen::Isometry3d& T_world_mesh, double lost) {
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, impl_->mesh_scenes[mesh]);
  const Eigen::Matrix<float, 3, 4> transform = toEmbree(T_world_mesh);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(impl_->world, geometry, unsigned(impl_->instances.size()));
  impl_->instances.push_back({mesh, geometry, transform.leftCols<3>(), lost});
  rtcCommitScene(impl_->world);
  return impl_->instances.size() - 1;
}

std::size_t Renderer::instanceCount() const {
  return impl_->instances.size();
}

void Renderer::moveInstance(std::size_t instance, const Eigen::Isometry3d& T_world_mesh) {
  Impl::Instance& moved = impl_->instances[instance];
  const Eigen::Matrix<float, 3, 4> transform = toEmbree(T_world_mesh);
  rtcSetGeometryTransform(moved.geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(moved.geometry);
  moved.R_world_mesh = transform.leftCols<3>();
  rtcCommitScene(impl_->world);
}

void Renderer::setVisible(std::size_t instance, bool visible) {
  const RTCGeometry geometry = impl_->instances[instance].geometry;
  if (visible) {
    rtcEnableGeometry(geometry);
  } else {
    rtcDisableGeometry(geometry);
  }
  rtcCommitScene(impl_->world);
}

namespace {

Rgb shaded(const Rgb& color, float cosine) {
  const float light = 0.3f + 0.7f * cosine;
  return {std::uint8_t(light * color.r), std::uint8_t(light * color.g), std::uint8_t(light * color.b)};
}

}  // namespace

Rgb Renderer::Impl::colorOf(const Hit& hit, const CameraModel& camera) const {
  const Mesh& mesh = *meshes[instances[hit.instance].mesh];
  const Rgb color = mesh.color(hit.triangle, hit.u, hit.v, hit.depth / float(camera.fx));
  return camera.shading ? shaded(color, hit.cosine) : color;
}

Eigen::Vector3f Renderer::Impl::lightOf(const Hit& hit, const Eigen::Vector3f& point, const CameraModel& camera,
                                        const Eigen::Vector3f& to_light) const {
  constexpr float lamp = 1.5f;  // distance of what may stand in the light [m]
  const auto share = float(camera.color.light);
  const float slope = std::max(0.0f, hit.normal.dot(to_light));
  const bool lit = share > 0 && slope > 0 && !blocked(point + lamp * to_light, point);
  return (1 - share + (lit ? 1.5f * share * slope : 0)) * toLinear(colorOf(hit, camera));
}

Eigen::AlignedBox2i Renderer::Impl::window(const CameraModel& camera, const Eigen::Isometry3d& T_world_camera) const {
  constexpr double margin = 2;  // [px]
  const Eigen::AlignedBox2i whole = wholePicture(camera);
  RTCBounds bounds;
  rtcGetSceneBounds(world, &bounds);
  const Eigen::AlignedBox3d box(Eigen::Vector3f(bounds.lower_x, bounds.lower_y, bounds.lower_z).cast<double>(),
                                Eigen::Vector3f(bounds.upper_x, bounds.upper_y, bounds.upper_z).cast<double>());
  if (box.isEmpty()) return whole;
  Eigen::AlignedBox2d seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p = T_world_camera.inverse() * box.corner(Eigen::AlignedBox3d::CornerType(corner));
    if (!(p.z() > 0)) return whole;
    seen.extend(Eigen::Vector2d(camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy));
  }
  const Eigen::Vector2d size(camera.width, camera.height);
  const auto pixel = [&](const Eigen::Vector2d& position) -> Eigen::Vector2i {
    return position.cwiseMax(-1.0).cwiseMin(size).cast<int>();
  };
  return whole.intersection(
      Eigen::AlignedBox2i(pixel(seen.min().array().floor() - margin), pixel(seen.max().array().ceil() + margin)));
}

Rendering Renderer::render(const CameraModel& camera, const Eigen::Isometry3d& T_world_camera, std::uint64_t frame,
                           std::uint64_t colors, int threads) const {
  validate(camera);
  Rendering result;
  Cloud& cloud = result.cloud;
  cloud.width = std::uint32_t(camera.width);
  cloud.height = std::uint32_t(camera.height);
  const std::size_t pixels = std::size_t(camera.width) * std::size_t(camera.height);
  cloud.points.assign(pixels, Eigen::Vector3f::Constant(nan));
  cloud.colors.resize(pixels);
  result.instance.assign(pixels, -1);
  const Eigen::Matrix3f R_world_camera = T_world_camera.linear().cast<float>();
  const Eigen::Vector3f eye = T_world_camera.translation().cast<float>();
  const Eigen::Vector3f projector = (T_world_camera * Eigen::Vector3d(camera.baseline, 0, 0)).cast<float>();
  const CameraNoise& noise = camera.noise;
  const DepthErrors errors(camera, frame, threads);
  const ColorDraw draw(camera.color, noise.seed, colors);
  const bool developed = camera.color.any();
  std::vector<Eigen::Vector3f> light(developed ? pixels : 0, Eigen::Vector3f::Zero());
  std::vector<float> true_depth(errors.needsEdges() ? pixels : 0, far);

  const bool moves_rays = noise.lateral || developed;  // by any number of pixels
  const Eigen::AlignedBox2i window = moves_rays ? wholePicture(camera) : impl_->window(camera, T_world_camera);
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
  for (int row = window.min().y(); row <= window.max().y(); ++row) {
    for (int column = window.min().x(); column <= window.max().x(); ++column) {
      const std::size_t pixel = std::size_t(row) * std::size_t(camera.width) + std::size_t(column);
      const Eigen::Vector3f ray = camera.ray(column, row);
      const Hit seen = impl_->cast(eye, R_world_camera * ray);
      if (seen.found) {
        cloud.colors[pixel] = impl_->colorOf(seen, camera);
        result.instance[pixel] = std::int32_t(seen.instance);
        if (!true_depth.empty()) true_depth[pixel] = seen.depth;
      }
      if (developed) {
        const Eigen::Vector3f way = R_world_camera * camera.ray(column + draw.offset.x(), row + draw.offset.y());
        const Hit colored = impl_->cast(eye, way);
        if (colored.found) light[pixel] = impl_->lightOf(colored, eye + colored.depth * way, camera, draw.to_light);
      }
      PixelRandom random(noise.seed, frame, pixel);
      const Eigen::Vector2d aside = errors.lateral(pixel, random);
      Hit hit = seen;
      Eigen::Vector3f direction = ray;
      if (noise.lateral) {
        const Eigen::Vector3f moved = camera.ray(column + aside.x(), row + aside.y());
        const Hit beside = impl_->cast(eye, R_world_camera * moved);
        if (!errors.smooth() || !seen.found || !beside.found || isEdge(seen.depth, beside.depth)) {
          hit = beside;
          direction = moved;
        }
      }
      if (!hit.found) continue;
      if (noise.shadow && impl_->blocked(projector, eye + hit.depth * (R_world_camera * direction))) continue;
      const SeenSurface surface{hit.depth, hit.cosine, impl_->instances[hit.instance].lost,
                                noise.dark ? impl_->colorOf(hit, camera) : Rgb{255, 255, 255}};
      const auto depth = float(errors.measured(surface, pixel, random));
      if (depth >= float(camera.min_range) && depth <= float(camera.max_range)) cloud.points[pixel] = depth * ray;
    }
  }
  if (errors.needsEdges()) errors.loseEdges(true_depth, cloud.points, threads);
  if (developed) cloud.colors = developPicture(std::move(light), camera, draw, frame, threads);
  return result;
}

std::vector<float> Rendering::depth() const {
  std::vector<float> depth;
  depth.reserve(cloud.size());
  for (const Eigen::Vector3f& p : cloud.points) depth.push_back(p.z());
  return depth;
}

}  // namespace sks
