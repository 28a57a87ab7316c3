// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <CLI/App.hpp>

#include <sks_detector/codebook.hpp>
#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>

#include "io/dataset.hpp"
#include "tools/mesh_options.hpp"

namespace sks::tools {

/// `--codebook FILE`, or the training of one: `--save-codebook FILE` and how meshes become views.
class CodebookOptions {
public:
  void add(CLI::App& command);

  /// The codebook of --codebook; nothing where that is not given. @throws what readCodebook() throws
  std::shared_ptr<const Codebook> read() const;

  /// Throws what saving would throw, before the work is done. @throws Error(bad_file)
  void check() const;

  /// Trains on a data set's training clouds, and saves the codebook where that is asked for.
  /// @throws Error(bad_usage) for a data set without any; what train() and writeCodebook() throw
  std::shared_ptr<const Codebook> train(const DataSet& data_set, const Settings& settings,
                                        const Progress& progress) const;

private:
  std::string codebook_;
  std::string save_;
  MeshViewOptions mesh_views_;
};

}  // namespace sks::tools
