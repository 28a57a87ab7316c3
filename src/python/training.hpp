// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

#include <sks_detector/progress.hpp>

#include "io/dataset.hpp"
#include "python/module.hpp"

namespace sks::python {

constexpr int default_mesh_views = 42;  ///< directions from which the command line looks at a mesh

/// Texts that threads without the GIL leave for warn(). Thread-safe.
class Remarks {
public:
  void add(const std::string& text);
  std::vector<std::string> take();

private:
  std::mutex mutex_;
  std::vector<std::string> texts_;
};

/// How the meshes of a data set become views: as the command line does it. @param remarks must outlive the sampler
MeshSampler meshViews(int views, Remarks& remarks);

/// Trains as `sks train` does; what is odd about the result is added to the remarks. Call it without the GIL.
std::shared_ptr<const Codebook> trainOn(const std::vector<TrainingSample>& samples, const Settings& settings,
                                        const std::string& name, const Progress& progress, Remarks& remarks);

}  // namespace sks::python
