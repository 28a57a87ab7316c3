// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_file.hpp"

#include <exception>
#include <mutex>

#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>

#include <sks_detector/error.hpp>

#include "io/point_fields.hpp"

namespace sks {
namespace {

/// Keeps PCL from printing while it lives; PCL's switch is global, so one at a time.
class QuietPcl {
public:
  QuietPcl() : lock_(mutex()), level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }

private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  pcl::console::VERBOSITY_LEVEL level_;
};

PointBlock describe(const pcl::PCLPointCloud2& blob) {
  PointBlock block;
  block.width = blob.width;
  block.height = blob.height;
  block.point_step = blob.point_step;
  block.row_step = std::size_t(blob.width) * blob.point_step;
  block.big_endian = blob.is_bigendian;
  for (const pcl::PCLPointField& field : blob.fields)
    block.fields.push_back({field.name, field.offset, field.datatype});
  block.data = blob.data.data();
  block.size = blob.data.size();
  return block;
}

}  // namespace

Cloud readPly(const std::string& path, double scale) {
  pcl::PCLPointCloud2 blob;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  try {
    const QuietPcl quiet;
    Eigen::Quaternionf orientation;
    int version = 0;
    if (pcl::PLYReader().read(path, blob, origin, orientation, version) < 0) {
      throw Error(ErrorCode::bad_data, "its data is truncated or damaged");
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorCode::bad_data, std::string("its data is damaged: ") + error.what());
  }
  Cloud cloud = toCloud(describe(blob), scale);
  cloud.sensor_origin = (scale * origin.head<3>().cast<double>()).cast<float>();
  return cloud;
}

}  // namespace sks
