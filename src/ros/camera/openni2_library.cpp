// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/openni2_library.hpp"

#include <array>
#include <mutex>
#include <sstream>
#include <vector>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"
#include "io/regular_file.hpp"

namespace sks_detector {
namespace {

using sks::Error;
using sks::ErrorCode;

std::mutex& libraryMutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<std::string> connectedUris() {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<std::string> uris;
  uris.reserve(static_cast<std::size_t>(infos.getSize()));
  for (int i = 0; i < infos.getSize(); ++i) uris.emplace_back(infos[i].getUri());
  return uris;
}

std::string listOf(const std::vector<std::string>& uris) {
  if (uris.empty()) return "none is connected (check the cable, and the udev rules of OpenNI2)";
  std::string text = "connected:";
  for (std::size_t i = 0; i < uris.size(); ++i) text += (i > 0 ? ", #" : " #") + std::to_string(i + 1) + " " + uris[i];
  return text;
}

bool isRecording(const std::string& name) {
  const std::string suffix = ".oni";
  return name.size() > suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
}

/// URI of the device with a serial number, which only an open device tells; empty if there is none.
std::string uriOfSerial(const std::string& serial, const std::vector<std::string>& uris) {
  for (const std::string& uri : uris) {
    openni::Device device;
    if (device.open(uri.c_str()) == openni::STATUS_OK && serialNumber(device) == serial) return uri;
  }
  return "";
}

/// The URI that a name stands for. A name that nothing is known of may be one that a driver knows.
std::string uriOf(const std::string& name, const std::vector<std::string>& uris) {
  for (const std::string& uri : uris) {
    if (uri == name) return name;
  }
  std::size_t number = 1;
  if (!name.empty() && name[0] != '#') {
    const std::string uri = uriOfSerial(name, uris);
    return uri.empty() ? name : uri;
  }
  if (int parsed = 0; !name.empty()) number = sks::fromText(name.substr(1), parsed) && parsed > 0 ? parsed : 0;
  if (number == 0 || number > uris.size()) {
    throw Error(ErrorCode::bad_data,
                "no OpenNI2 camera " + (name.empty() ? "" : "'" + name + "' ") + "(~device): " + listOf(uris));
  }
  return uris[number - 1];
}

void openRecording(const std::string& path, openni::Device& device) {
  try {
    const sks::RegularFile there(path);
  } catch (const Error& error) {
    throw Error(error.code(), path + " (~device) cannot be read: " + error.what());
  }
  if (device.open(path.c_str()) != openni::STATUS_OK) {
    throw Error(ErrorCode::bad_file, path + " (~device) cannot be played: " + openNi2Error());
  }
}

}  // namespace

std::shared_ptr<OpenNi2Library> OpenNi2Library::get() {
  static std::weak_ptr<OpenNi2Library> shared;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (auto library = shared.lock()) return library;
  {
    const std::lock_guard<std::mutex> library_lock(libraryMutex());
    if (openni::OpenNI::initialize() != openni::STATUS_OK) {
      throw Error(ErrorCode::bad_data, "OpenNI2 cannot be used: " + openNi2Error());
    }
  }
  std::shared_ptr<OpenNi2Library> library(new OpenNi2Library);
  shared = library;
  return library;
}

OpenNi2Library::~OpenNi2Library() {
  const std::lock_guard<std::mutex> lock(libraryMutex());
  openni::OpenNI::shutdown();
}

void OpenNi2Library::open(const std::string& name, openni::Device& device) const {
  const std::lock_guard<std::mutex> lock(libraryMutex());
  if (isRecording(name)) return openRecording(name, device);
  const std::vector<std::string> uris = connectedUris();
  const std::string uri = uriOf(name, uris);
  if (device.open(uri.c_str()) != openni::STATUS_OK) {
    throw Error(ErrorCode::bad_data,
                "camera '" + uri + "' (~device) cannot be opened: " + openNi2Error() + "; " + listOf(uris));
  }
}

std::string serialNumber(const openni::Device& device) {
  std::array<char, 256> text{};
  int size = int(text.size() - 1);
  if (device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, text.data(), &size) != openni::STATUS_OK) return "";
  return text.data();
}

std::string openNi2Error() {
  std::istringstream lines(openni::OpenNI::getExtendedError());
  std::string line, text;
  while (std::getline(lines >> std::ws, line)) text += (text.empty() ? "" : "; ") + line;
  return text.empty() ? "no reason given" : text;
}

}  // namespace sks_detector
