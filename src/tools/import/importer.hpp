// SPDX-License-Identifier: BSD-3-Clause
// What the importers of `sks import` share. Each format is one file with one function that lists a downloaded folder as
// a data set; clouds and meshes that can be used as they are stay where they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sks_detector/progress.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

struct ImportOptions {
  std::string folder;                   ///< as downloaded
  std::string output;                   ///< data set file to write
  std::string name;                     ///< of the data set; empty: that of the folder
  std::string units;                    ///< m or mm; empty: what the format has
  std::string split;                    ///< BOP: folder of images; empty: the first of test*, val*, train*
  std::string models = "models";        ///< BOP: folder of meshes
  std::string classification = "base";  ///< PSB: folder of the .cla files, e.g. base or coarse1
  int points = 6000;                    ///< of a cloud that is sampled from a mesh
  double diagonal = 0.5;                ///< of the box of such a cloud [m]
  int every = 0;                        ///< every n-th frame or image is taken; 0: what the format's evaluation does
};

/// What an import found, with lengths in its own units.
struct ImportedSet {
  DataSet data_set;
  std::string units = "m";
  std::vector<std::string> warnings;  ///< what was left out or mended, with counts
};

/// Where an import writes clouds that it has to make, and how it says where it stands.
class ImportContext {
public:
  ImportContext(ImportOptions options, Progress progress);

  const ImportOptions& options() const { return options_; }
  const Progress& progress() const { return progress_; }

  /// Writes a cloud below the folder `<output without extension>_clouds`. @param name e.g. "train/chair_0001"
  /// @return its path
  std::string writeCloud(const std::string& name, const Cloud& cloud) const;

private:
  ImportOptions options_;
  Progress progress_;
};

/// Each lists the folder of one format. @throws Error(bad_file), Error(bad_data) naming the file and what is wrong
ImportedSet importUnibo(const ImportContext& context);
ImportedSet importPrinceton(const ImportContext& context);
ImportedSet importModelNet(const ImportContext& context);
ImportedSet importWashington(const ImportContext& context);
ImportedSet importBigBird(const ImportContext& context);
ImportedSet importBop(const ImportContext& context);

/// Folders in a folder, by name. @throws Error(bad_file)
std::vector<std::filesystem::path> foldersIn(const std::filesystem::path& folder);
/// Files in a folder with an extension (with its dot, in any case), ordered so that 2 comes before 10.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder, const std::string& extension);
/// The same in all folders below.
std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder, const std::string& extension);
/// Whether one name comes before another, with whole numbers compared as numbers.
bool beforeByNumber(const std::string& a, const std::string& b);

/// A training entry or test of a file that stays where it is.
TrainingEntry trainingEntry(const std::string& object, const std::filesystem::path& path, ViewKind kind);

/// The data set as text, its paths relative to the folder of `output`.
std::string dataSetYaml(const ImportedSet& set, const std::string& output);

}  // namespace sks::tools
