// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_content.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

/// Closes a file descriptor at the end of its scope.
struct Descriptor {
  explicit Descriptor(const std::string& path) : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  const int number;
};

[[noreturn]] void failBySystem() {
  throw Error(ErrorCode::bad_file, std::generic_category().message(errno));
}

constexpr std::size_t block_size = 1 << 20;  // [bytes]

/// As many bytes from the offset as there are, up to `size`.
std::size_t readSome(int file, std::uint8_t* to, std::size_t size, std::size_t offset) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::pread(file, to + done, size - done, off_t(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failBySystem();
    if (count == 0) break;
    done += std::size_t(count);
  }
  return done;
}

/// Copies a file to memory that is zero. Fewer bytes than `size` where it was truncated meanwhile.
std::size_t copy(int file, std::uint8_t* to, std::size_t size) {
  std::vector<std::uint8_t> block(std::min(size, block_size));
  std::size_t done = 0;
  while (done < size) {
    const std::size_t count = readSome(file, block.data(), std::min(block.size(), size - done), done);
    if (count == 0) break;
    const bool zero =
        std::all_of(block.begin(), block.begin() + std::ptrdiff_t(count), [](auto byte) { return byte == 0; });
    if (!zero) std::memcpy(to + done, block.data(), count);
    done += count;
  }
  return done;
}

bool beginsWith(int file, const std::string& magic) {
  std::vector<std::uint8_t> begin(magic.size());
  return readSome(file, begin.data(), begin.size(), 0) == magic.size() &&
         std::equal(magic.begin(), magic.end(), begin.begin(),
                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

}  // namespace

FileContent::FileContent(const std::string& path, const std::string& magic) {
  const Descriptor file(path);
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) failBySystem();
  if (S_ISDIR(status.st_mode)) throw Error(ErrorCode::bad_file, "it is a folder; give the name of a file");
  if (!S_ISREG(status.st_mode)) throw Error(ErrorCode::bad_file, "it is no regular file");
  auto size = std::size_t(status.st_size);
  if (!magic.empty() && !beginsWith(file.number, magic)) size = std::min(size, magic.size());
  if (size == 0) return;  // memory of no size cannot be reserved
  void* const data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) failBySystem();
  data_ = static_cast<std::uint8_t*>(data);
  reserved_ = size;
  try {
    size_ = copy(file.number, data_, size);
  } catch (...) {
    ::munmap(data_, reserved_);
    throw;
  }
}

FileContent::~FileContent() {
  if (data_) ::munmap(data_, reserved_);
}

}  // namespace sks
