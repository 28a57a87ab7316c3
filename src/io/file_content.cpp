// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_content.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

#include "io/regular_file.hpp"

namespace sks {
namespace {

constexpr std::size_t block_size = 1 << 20;         // [bytes]
constexpr std::size_t worth_large_pages = 8 << 20;  // [bytes] several pages of 2 MB

/// Copies a file to memory that is zero. Fewer bytes than `size` where it was truncated meanwhile.
std::size_t copy(const RegularFile& file, std::uint8_t* to, std::size_t size) {
  std::vector<std::uint8_t> block(std::min(size, block_size));
  std::size_t done = 0;
  while (done < size) {
    const std::size_t count = file.read(block.data(), std::min(block.size(), size - done), done);
    if (count == 0) break;
    const bool zero =
        std::all_of(block.begin(), block.begin() + std::ptrdiff_t(count), [](auto byte) { return byte == 0; });
    if (!zero) std::memcpy(to + done, block.data(), count);
    done += count;
  }
  return done;
}

bool beginsWith(const RegularFile& file, const std::string& magic) {
  std::vector<std::uint8_t> begin(magic.size());
  return file.read(begin.data(), begin.size(), 0) == magic.size() &&
         std::equal(magic.begin(), magic.end(), begin.begin(),
                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

}  // namespace

FileContent::FileContent(const std::string& path, const std::string& magic) {
  const RegularFile file(path);
  std::size_t size = file.size();
  if (!magic.empty() && !beginsWith(file, magic)) size = std::min(size, magic.size());
  reserve(size);
  try {
    size_ = copy(file, data_, size);
  } catch (...) {
    if (data_) ::munmap(data_, reserved_);
    throw;
  }
}

FileContent::FileContent(const char* data, std::size_t size) {
  reserve(size);
  if (size > 0) std::memcpy(data_, data, size);
  size_ = size;
}

void FileContent::reserve(std::size_t size) {
  if (size == 0) return;  // memory of no size cannot be reserved
  void* const data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) throw Error(ErrorCode::bad_file, std::generic_category().message(errno));
  data_ = static_cast<std::uint8_t*>(data);
  reserved_ = size;
#ifdef MADV_HUGEPAGE
  if (size >= worth_large_pages) ::madvise(data, size, MADV_HUGEPAGE);  // a wish: thousands of pages take time to get
#endif
}

void FileContent::release(std::size_t offset, std::size_t size) {
  const auto page = std::size_t(::sysconf(_SC_PAGESIZE));
  const std::size_t begin = (offset + page - 1) / page * page, end = (offset + size) / page * page;
  if (begin < end) ::madvise(data_ + begin, end - begin, MADV_DONTNEED);
}

FileContent::~FileContent() {
  if (data_) ::munmap(data_, reserved_);
}

}  // namespace sks
