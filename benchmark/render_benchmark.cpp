// SPDX-License-Identifier: BSD-3-Clause
// A coloured, organised VGA cloud of ten objects on a table.
#include <benchmark/benchmark.h>

#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace {

sks::Renderer tableWithTenObjects() {
  sks::Renderer renderer;
  const auto add = [&](sks::Mesh mesh, double x, double y, double z) {
    const std::size_t number = renderer.addMesh(std::make_shared<const sks::Mesh>(std::move(mesh)));
    renderer.addInstance(number, Eigen::Isometry3d(Eigen::Translation3d(x, y, z)));
  };
  add(sks::makeBox({1.2f, 1.2f, 0.02f}, sks::plain({150, 110, 80})), 0, 0, 1.2);
  for (int i = 0; i < 10; ++i) {
    add(sks::makeSphere(0.05f, 5, sks::plain({std::uint8_t(20 * i), 100, 50})), 0.12 * (i % 5 - 2),
        0.15 * (i / 5) - 0.1, 1.14);
  }
  return renderer;
}

void render(benchmark::State& state, bool noise) {
  const sks::Renderer renderer = tableWithTenObjects();
  sks::CameraModel camera;
  if (!noise) camera.noise = sks::CameraNoise::none();
  std::uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render(camera, Eigen::Isometry3d::Identity(), frame++, 2));
  }
}

BENCHMARK_CAPTURE(render, exact, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(render, noisy, true)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
