// SPDX-License-Identifier: BSD-3-Clause
//
// Records frames of an OpenNI2 camera: record_oni URI FILE SECONDS [WIDTH]
#include <cstdlib>
#include <iostream>
#include <thread>

#include <OpenNI.h>

namespace {

void check(openni::Status status, const char* action) {
  if (status == openni::STATUS_OK) return;
  std::cerr << "cannot " << action << ": " << openni::OpenNI::getExtendedError() << "\n";
  std::exit(1);
}

/// Sets the last of the modes of a width, in a format that recordings can hold.
void setWidth(openni::VideoStream& stream, int width) {
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const bool usable = modes[i].getPixelFormat() != openni::PIXEL_FORMAT_YUV422;
    if (usable && modes[i].getResolutionX() == width) check(stream.setVideoMode(modes[i]), "set the mode");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  check(openni::OpenNI::initialize(), "initialize OpenNI2");
  openni::Device device;
  check(device.open(argv[1]), "open the camera");
  if (device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR)) {
    check(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), "register");
  }
  openni::VideoStream depth, color;
  check(depth.create(device, openni::SENSOR_DEPTH), "open depth");
  check(color.create(device, openni::SENSOR_COLOR), "open colour");
  for (openni::VideoStream* stream : {&depth, &color}) {
    if (argc > 4) setWidth(*stream, std::atoi(argv[4]));
  }
  openni::Recorder recorder;
  check(recorder.create(argv[2]), "create the file");
  check(recorder.attach(depth), "attach depth");
  check(recorder.attach(color), "attach colour");
  check(recorder.start(), "start recording");
  check(depth.start(), "start depth");
  check(color.start(), "start colour");
  std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(argv[3])));
  recorder.stop();
  depth.stop();
  color.stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the Dummy driver's threads end late
  recorder.destroy();
  depth.destroy();
  color.destroy();
  device.close();
  openni::OpenNI::shutdown();
  return 0;
}
