// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic_stream.hpp"

#include <chrono>

#include "synthetic_view.hpp"

namespace sks::test {
namespace {

constexpr int baseline = 10;  // [px] that depth is off while it is not registered

}  // namespace

SyntheticStream::SyntheticStream(OniSensorType type, const std::atomic<bool>& registered,
                                 const std::atomic<bool>& gives_frames)
    : type_(type), registered_(registered), gives_frames_(gives_frames) {
  mode_ = {isDepth() ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888, 320, 240, 30};
}

SyntheticStream::~SyntheticStream() {
  stop();
}

OniStatus SyntheticStream::start() {
  running_ = true;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void SyntheticStream::stop() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

OniStatus SyntheticStream::getProperty(int id, void* data, int* size) {
  const SyntheticView view{mode_.resolutionX, mode_.resolutionY};
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give(mode_, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return give(OniBool(mirrored_), data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return give(float(2 * std::atan(0.5 * view.width / view.focalLength())), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give(float(2 * std::atan(0.5 * view.height / view.focalLength())), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // a recording without it gives no frames
      return give(OniCropping{}, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return give(0, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return give(10000, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus SyntheticStream::setProperty(int id, const void* data, int) {
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    mode_ = *static_cast<const OniVideoMode*>(data);
  } else if (id == ONI_STREAM_PROPERTY_MIRRORING) {
    mirrored_ = *static_cast<const OniBool*>(data) != FALSE;
  } else {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  return ONI_STATUS_OK;
}

OniBool SyntheticStream::isPropertySupported(int id) {
  return id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_MIRRORING ||
         id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV || id == ONI_STREAM_PROPERTY_VERTICAL_FOV ||
         id == ONI_STREAM_PROPERTY_MIN_VALUE || id == ONI_STREAM_PROPERTY_MAX_VALUE;
}

int SyntheticStream::getRequiredFrameSize() {
  return mode_.resolutionX * mode_.resolutionY * pixelSize();
}

void SyntheticStream::run() {
  using namespace std::chrono;
  const std::vector<std::uint8_t> image = render();
  const microseconds period(1000000 / mode_.fps);
  long long index = steady_clock::now().time_since_epoch() / period;
  while (running_) {
    std::this_thread::sleep_until(steady_clock::time_point(++index * period));
    if (running_ && gives_frames_) sendFrame(image, index);
  }
}

std::vector<std::uint8_t> SyntheticStream::render() const {
  const SyntheticView view{mode_.resolutionX, mode_.resolutionY};
  const int shift = isDepth() && !registered_ ? baseline : 0;
  std::vector<std::uint8_t> image;
  for (int v = 0; v < view.height; ++v) {
    for (int column = 0; column < view.width; ++column) {
      const int u = (mirrored_ ? view.width - 1 - column : column) + shift;
      if (isDepth()) {
        const std::uint16_t depth = view.depth(u, v);
        image.push_back(std::uint8_t(depth & 0xff));
        image.push_back(std::uint8_t(depth >> 8));
      } else {
        for (const std::uint8_t value : view.color(u, v)) image.push_back(value);
      }
    }
  }
  return image;
}

void SyntheticStream::sendFrame(const std::vector<std::uint8_t>& image, long long index) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  std::memcpy(frame->data, image.data(), image.size());
  frame->dataSize = int(image.size());
  frame->sensorType = type_;
  frame->timestamp = std::uint64_t(index) * std::uint64_t(1000000 / mode_.fps);
  frame->frameIndex = int(index & 0x7fffffff);
  frame->width = mode_.resolutionX;
  frame->height = mode_.resolutionY;
  frame->videoMode = mode_;
  frame->croppingEnabled = FALSE;
  frame->cropOriginX = frame->cropOriginY = 0;
  frame->stride = mode_.resolutionX * pixelSize();
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace sks::test
