// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

#include "io/dataset.hpp"

namespace sks {

/// Training views that were captured with a camera, kept as a data set of their own: `<folder>/dataset.yaml` and
/// `<folder>/<object>/000.pcd`, `001.pcd` ... The files are all there is: nothing is lost over restarts, and entries
/// may be taken out by hand. Safe to use from several threads, and from several processes: who changes them holds the
/// lock of `<folder>/.lock`.
class CapturedViews {
public:
  /// @param folder need not exist; it is made when it is needed
  explicit CapturedViews(std::string folder);

  struct Added {
    std::string file;
    std::size_t views = 0;  ///< of this object, with the new one
  };
  /// Stores a view, then lists it. @throws Error(bad_usage) for a name that is not fit for a folder, or if the data set
  /// file has been changed to millimetres; Error(bad_file) if the files cannot be read or written, or others have been
  /// changing them for long
  /// @param plane that the object stands on, its normal towards the object; in the frame of the view
  /// @param T_fixed_view see TrainingEntry::T_fixed_cloud
  Added add(const std::string& object, const Cloud& view,
            const std::optional<Eigen::Hyperplane<double, 3>>& plane = std::nullopt,
            const std::optional<Eigen::Isometry3d>& T_fixed_view = std::nullopt);

  struct Removed {
    std::string file;       ///< of the view that was taken out
    std::size_t views = 0;  ///< of this object that are left
  };
  /// Takes the last view of an object out and deletes it. @throws Error(bad_usage) if there is none; as add()
  Removed removeLast(const std::string& object);

  /// Takes all views of an object out and deletes those that add() stored. Returns how many were listed.
  std::size_t remove(const std::string& object);

  /// What is there, in its order; without entries if there is nothing. Views whose files are gone are `missing`, with
  /// a warning each.
  /// @throws Error(bad_file), Error(bad_data) naming file and line if the data set file is damaged
  DataSet read() const;

  /// Names of the objects, in order of their first view. @throws like read()
  std::vector<std::string> objects() const;

  const std::string& file() const { return file_; }  ///< of the data set

private:
  DataSet readUnlocked() const;
  std::string objectFolder(const std::string& object) const;

  std::string folder_;
  std::string file_;
  std::string lock_file_;
  mutable std::mutex mutex_;
};

}  // namespace sks
