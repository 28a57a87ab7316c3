// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "core/sharing/bytes.hpp"

namespace sks {

/// Processes that do one piece of work together. All run the same command on the same files, and call the functions of
/// this class in the same order; one of them, the leader, collects what the others find. Where there is only one
/// process there is no WorkShare, but a null pointer. Not thread-safe.
class WorkShare {
public:
  /// Does one item and gives its result as bytes. Each process is given items in ascending order.
  using Work = std::function<std::string(std::size_t item)>;
  /// Takes the result of one item.
  using Take = std::function<void(std::size_t item, const std::string& result)>;
  /// Told how many items were taken; may throw to end the work.
  using Report = std::function<void(std::size_t done)>;

  WorkShare() = default;
  virtual ~WorkShare() = default;
  WorkShare(const WorkShare&) = delete;
  WorkShare& operator=(const WorkShare&) = delete;

  virtual bool leads() const = 0;

  /// Deals out items one at a time, to whichever process is free, the leader too. Returns when all were taken.
  /// @param work called by one thread in each process
  /// @param take called in the leader alone, by the calling thread, in the order of the items
  /// @throws what `work` throws in any process, in the leader with the place where it happened
  virtual void deal(std::size_t count, const Work& work, const Take& take, const Report& report) = 0;

  /// Makes `bytes` in every process those of the leader.
  virtual void spread(std::string& bytes) = 0;
};

/// Makes items, here or in all processes of a share, and takes them in their order.
/// @param make of an index; in each process @param take of index and item; in the leader
template <typename Item, typename Make, typename Take>
void dealOut(WorkShare* share, std::size_t count, const Make& make, const Take& take, const WorkShare::Report& report) {
  if (share == nullptr) {
    for (std::size_t i = 0; i < count; ++i) {
      report(i);
      take(i, make(i));
    }
    return;
  }
  share->deal(
      count, [&](std::size_t i) { return bytesOf<Item>(make(i)); },
      [&](std::size_t i, const std::string& bytes) { take(i, fromBytes<Item>(bytes)); }, report);
}

}  // namespace sks
