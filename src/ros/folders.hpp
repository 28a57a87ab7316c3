// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ros/node_settings.hpp"

namespace sks_detector {

/// ~codebook, absolute, as are the folders: `~/` is taken to be the home folder; empty where none is set.
std::string codebookFile(const NodeSettings& settings);

/// ~codebook_directory, or what takes its place where it is empty; absolute.
std::string codebookDirectory(const NodeSettings& settings);

/// ~dataset_directory, or what takes its place where it is empty; absolute.
std::string datasetDirectory(const NodeSettings& settings);

/// Makes the folder of a file that is to be written, with those above it. @throws sks::Error(bad_file)
void makeFolderOf(const std::string& file);

}  // namespace sks_detector
