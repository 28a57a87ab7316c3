// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

#include <Driver/OniDriverAPI.h>

namespace sks::test {

/// Hands a property out, as OpenNI2 asks for it.
template <typename Value>
OniStatus give(const Value& value, void* data, int* size) {
  if (*size != int(sizeof(Value))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(Value));
  return ONI_STATUS_OK;
}

/// Depth or colour of the synthetic camera. The clocks of all streams agree.
class SyntheticStream : public oni::driver::StreamBase {
public:
  SyntheticStream(OniSensorType type, const std::atomic<bool>& registered, const std::atomic<bool>& gives_frames);
  ~SyntheticStream() override;

  OniStatus start() override;
  void stop() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  int getRequiredFrameSize() override;

private:
  bool isDepth() const { return type_ == ONI_SENSOR_DEPTH; }
  int pixelSize() const { return isDepth() ? 2 : 3; }
  void run();
  std::vector<std::uint8_t> render() const;
  void sendFrame(const std::vector<std::uint8_t>& image, long long index);

  const OniSensorType type_;
  const std::atomic<bool>& registered_;
  const std::atomic<bool>& gives_frames_;
  OniVideoMode mode_;
  std::atomic<bool> mirrored_{true};
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace sks::test
