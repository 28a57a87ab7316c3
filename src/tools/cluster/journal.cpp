// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cluster/journal.hpp"

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "io/crc32c.hpp"
#include "io/file.hpp"

namespace sks::tools {
namespace {

constexpr const char* first_words = "sks journal 1 ";
constexpr std::size_t checksum_digits = 8;
constexpr const char* hex_digits = "0123456789abcdef";

std::string checksumOf(const std::string& text) {
  return formatted("%08x", crc32c(text.data(), text.size()));
}

std::string toHex(const std::string& bytes) {
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += hex_digits[byte >> 4];
    text += hex_digits[byte & 15];
  }
  return text;
}

/// Nothing where the text is no hexadecimal number of whole bytes.
std::optional<std::string> fromHex(const std::string& text) {
  if (text.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 2);
  for (std::size_t i = 0; i < text.size(); i += 2) {
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(&text[i], &text[i] + 2, byte, 16);
    if (error != std::errc() || end != &text[i] + 2) return std::nullopt;
    bytes += char(byte);
  }
  return bytes;
}

/// The text of the line that begins there, if it is whole.
std::optional<std::string> wholeLine(const std::string& content, std::size_t begin) {
  const std::size_t end = content.find('\n', begin);
  if (end == std::string::npos || end < begin + checksum_digits + 1) return std::nullopt;
  std::string text = content.substr(begin + checksum_digits + 1, end - begin - checksum_digits - 1);
  if (content.compare(begin, checksum_digits, checksumOf(text)) != 0) return std::nullopt;
  return text;
}

}  // namespace

Journal::OpenFile::~OpenFile() {
  if (descriptor >= 0) ::close(descriptor);
}

Journal::Journal(const std::string& path, const std::string& work)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_.descriptor < 0) fail(std::generic_category().message(errno));
  if (::flock(file_.descriptor, LOCK_EX | LOCK_NB) != 0) fail("another run writes it");
  const std::string content = readTextFile(path, std::numeric_limits<std::size_t>::max());
  const std::optional<std::string> head = wholeLine(content, 0);
  const bool foreign = head ? *head != first_words + work : content.find('\n') != std::string::npos;
  if (foreign) {
    throw Error(ErrorCode::bad_usage, "'" + shown(path) +
                                          "' is the journal of another run (with another codebook, data set, method or "
                                          "other settings), or none: remove it, or leave out --resume");
  }
  const std::size_t around = checksum_digits + 2;  // the text of a line [bytes]
  std::size_t whole = head ? around + head->size() : 0;
  while (const auto line = head ? wholeLine(content, whole) : std::nullopt) {
    std::size_t item = 0;
    const auto [end, error] = std::from_chars(line->data(), line->data() + line->size(), item);
    const auto digits = std::size_t(end - line->data());
    auto bytes = error == std::errc() && digits < line->size() ? fromHex(line->substr(digits + 1)) : std::nullopt;
    if (!bytes) break;
    known_[item] = std::move(*bytes);
    whole += around + line->size();
  }
  if (::ftruncate(file_.descriptor, off_t(whole)) != 0) fail(std::generic_category().message(errno));
  if (!head) addLine(first_words + work);
}

void Journal::add(std::size_t item, const std::string& result) {
  addLine(std::to_string(item) + " " + toHex(result));
}

void Journal::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void Journal::addLine(const std::string& text) {
  const std::string line = checksumOf(text) + " " + text + "\n";
  for (std::size_t at = 0; at < line.size();) {
    const ssize_t count = ::write(file_.descriptor, line.data() + at, line.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(std::generic_category().message(errno));
    at += std::size_t(count);
  }
}

void Journal::fail(const std::string& reason) const {
  throw Error(ErrorCode::bad_file, "cannot write the journal '" + shown(path_) + "': " + reason);
}

void JournaledShare::deal(std::size_t count, const Work& work, const Take& take, const Report& report) {
  std::vector<std::uint64_t> rest;
  for (std::size_t i = 0; leads() && i < count; ++i) {
    if (journal_->known().count(i) == 0) rest.push_back(i);
  }
  if (share_ != nullptr) {
    std::string bytes = leads() ? bytesOf(rest) : "";
    share_->spread(bytes);
    rest = fromBytes<std::vector<std::uint64_t>>(bytes);
  }
  std::size_t next = 0;  // that is to be taken
  const auto takeKnown = [&] {
    for (auto known = journal_->known().find(next); next < count && known != journal_->known().end();
         known = journal_->known().find(next)) {
      take(next++, known->second);
    }
  };
  const auto takeNew = [&](std::size_t i, const std::string& result) {
    next = std::size_t(rest[i]);
    journal_->add(next, result);
    take(next++, result);
    takeKnown();
  };
  const auto workOnRest = [&](std::size_t i) { return work(std::size_t(rest[i])); };
  const auto reportAll = [&](std::size_t) { report(next); };
  if (leads()) takeKnown();
  if (share_ != nullptr) return share_->deal(rest.size(), workOnRest, takeNew, reportAll);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    reportAll(i);
    takeNew(i, workOnRest(i));
  }
}

}  // namespace sks::tools
