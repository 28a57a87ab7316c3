// SPDX-License-Identifier: BSD-3-Clause
// Bytes between processes. MPI itself waits by computing: these functions look and sleep instead, so that a process
// that waits leaves its core to those that work.
#pragma once

#include <algorithm>
#include <chrono>
#include <climits>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <mpi.h>

#include <sks_detector/error.hpp>

namespace sks::tools {

constexpr int leader_rank = 0;

/// Sleeps between looks, at first for a short time.
class Pause {
public:
  void sleep() {
    std::this_thread::sleep_for(next_);
    next_ = std::min(2 * next_, longest);
  }
  void reset() { next_ = shortest; }

private:
  using Duration = std::chrono::microseconds;
  static constexpr Duration shortest{50}, longest{2000};

  Duration next_ = shortest;
};

/// Waits until MPI has done something. @param check called between looks; may throw
template <typename Check>
void await(MPI_Request request, const Check& check) {
  Pause pause;
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    check();
    pause.sleep();
  }
}

/// @param check as in await() @throws Error(bad_data) for more than MPI can send at once
template <typename Check>
void sendBytes(int to, int tag, const std::string& bytes, const Check& check) {
  if (bytes.size() > std::size_t(INT_MAX)) {
    throw Error(ErrorCode::bad_data, "the result of one item is larger than 2 GiB, which is more than can be sent");
  }
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(bytes.data(), int(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  await(request, check);
}

/// The sender and the bytes, if there are some by now.
inline std::optional<std::pair<int, std::string>> receiveBytes(int from, int tag) {
  int there = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(from, tag, MPI_COMM_WORLD, &there, &message, &status);
  if (there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(std::size_t(size), '\0');
  MPI_Mrecv(bytes.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  return std::make_pair(status.MPI_SOURCE, std::move(bytes));
}

}  // namespace sks::tools
