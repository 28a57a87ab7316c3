// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/assimp_files.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include <assimp/IOStream.hpp>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

/// A file in memory.
class AssimpStream : public Assimp::IOStream {
public:
  explicit AssimpStream(std::string content) : content_(std::move(content)) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t read = std::min(count, (content_.size() - position_) / size);
    std::memcpy(to, content_.data() + position_, read * size);
    position_ += read * size;
    return read;
  }
  std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? position_ : content_.size();
    const std::size_t target = base + offset;  // assimp hands negative offsets over as huge ones: they wrap around
    if (target > content_.size()) return aiReturn_FAILURE;
    position_ = target;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return position_; }
  std::size_t FileSize() const override { return content_.size(); }
  void Flush() override {}

private:
  const std::string content_;
  std::size_t position_ = 0;
};

}  // namespace

bool AssimpFiles::Exists(const char* name) const {
  if (name == files_.mesh()) return true;
  try {
    files_.find(name);
    return true;
  } catch (const Error&) {
    return false;
  }
}

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* mode) {
  if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr) return nullptr;
  try {
    std::string content = name == files_.mesh() ? files_.readMesh() : MeshFiles::read(files_.find(name));
    return std::make_unique<AssimpStream>(std::move(content)).release();
  } catch (const Error&) {
    return nullptr;  // assimp says then which one it cannot open
  }
}

void AssimpFiles::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace sks
