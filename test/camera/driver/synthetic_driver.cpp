// SPDX-License-Identifier: BSD-3-Clause
//
// An OpenNI2 driver of one synthetic camera, loaded as OpenNI2 loads those of real ones. The file that the environment
// variable SKS_TEST_CAMERA_STATE names can hold "unplugged" or "silent" (connected, but no frame comes); otherwise the
// camera works. As real ones do it mirrors its images unless told not to, and its depth is seen from beside the colour
// camera unless it is registered.
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "synthetic_stream.hpp"

namespace sks::test {
namespace {

/// Fills one of the fixed texts of OpenNI2.
void copyText(const char* from, char* to) {
  std::strncpy(to, from, ONI_MAX_STR - 1);
}

class SyntheticDevice : public oni::driver::DeviceBase {
public:
  explicit SyntheticDevice(const std::atomic<bool>& gives_frames) : gives_frames_(gives_frames) {
    sensors_[0] = {ONI_SENSOR_DEPTH, int(depth_modes_.size()), depth_modes_.data()};
    sensors_[1] = {ONI_SENSOR_COLOR, int(color_modes_.size()), color_modes_.data()};
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_.data();
    *count = int(sensors_.size());
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return new SyntheticStream(type, registered_, gives_frames_);
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniStatus getProperty(int id, void* data, int* size) override {
    if (id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER) {
      const char serial[] = "SKS-0001";
      if (*size < int(sizeof(serial))) return ONI_STATUS_BAD_PARAMETER;
      std::memcpy(data, serial, sizeof(serial));
      return ONI_STATUS_OK;
    }
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? give(OniBool(registered_), data, size)
                                                        : ONI_STATUS_NOT_SUPPORTED;
  }
  OniStatus setProperty(int id, const void* data, int) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
    registered_ = *static_cast<const int*>(data) == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    return ONI_STATUS_OK;
  }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }

private:
  std::array<OniVideoMode, 3> depth_modes_{{{ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30},
                                            {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 60},
                                            {ONI_PIXEL_FORMAT_DEPTH_1_MM, 640, 480, 30}}};
  std::array<OniVideoMode, 4> color_modes_{{{ONI_PIXEL_FORMAT_YUV422, 640, 480, 30},
                                            {ONI_PIXEL_FORMAT_RGB888, 320, 240, 30},
                                            {ONI_PIXEL_FORMAT_RGB888, 320, 240, 60},
                                            {ONI_PIXEL_FORMAT_RGB888, 640, 480, 30}}};
  std::array<OniSensorInfo, 2> sensors_{};
  const std::atomic<bool>& gives_frames_;
  std::atomic<bool> registered_{false};
};

class SyntheticDriver : public oni::driver::DriverBase {
public:
  explicit SyntheticDriver(OniDriverServices* services) : DriverBase(services) {
    copyText("sks-test://0", info_.uri);
    copyText("SKS", info_.vendor);
    copyText("synthetic camera", info_.name);
  }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    watch();
    thread_ = std::thread([this] {
      while (!stopping_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        watch();
      }
    });
    return ONI_STATUS_OK;
  }

  void shutdown() override {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    return plugged_ ? new SyntheticDevice(gives_frames_) : nullptr;
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void* enableFrameSync(oni::driver::StreamBase**, int) override { return this; }

private:
  void watch() {
    const char* path = std::getenv("SKS_TEST_CAMERA_STATE");
    std::string state;
    if (path != nullptr) std::ifstream(path) >> state;
    const bool plugged = state != "unplugged";
    gives_frames_ = state.empty();
    if (plugged == plugged_) return;
    plugged_ = plugged;
    if (plugged) {
      deviceConnected(&info_);
    } else {
      deviceDisconnected(&info_);
    }
  }

  OniDeviceInfo info_{};
  std::atomic<bool> plugged_{false};
  std::atomic<bool> gives_frames_{false};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace
}  // namespace sks::test

// Of OpenNI2's own library, whose headers are not installed.
#define XN_NEW(type, argument) new type(argument)
#define XN_DELETE(pointer) delete (pointer)
ONI_EXPORT_DRIVER(sks::test::SyntheticDriver)
