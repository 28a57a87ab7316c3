// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <mpi.h>

#include <sks_detector/error.hpp>

#include "core/sharing/bytes.hpp"
#include "tools/cluster/mpi/local_worker.hpp"
#include "tools/cluster/mpi/messages.hpp"
#include "tools/cluster/process_share.hpp"

namespace sks::tools {

/// What a process sends to ask for an item: the result of the last one.
struct ItemRequest {
  std::int64_t item = -1;  // none: its first request
  std::string result;
};

template <typename Archive>
void fields(Archive& archive, ItemRequest& request) {
  archive(request.item, request.result);
}

struct HandedFailure {
  std::string message;
  int status = 1;
};

template <typename Archive>
void fields(Archive& archive, HandedFailure& failure) {
  archive(failure.message, failure.status);
}

namespace {

constexpr int tag_request = 1, tag_item = 2, tag_failure = 3;
constexpr std::int64_t no_more = -1;                // in place of an item
constexpr std::size_t items_ahead = 16;             // for each process: results that wait for earlier ones take memory
constexpr std::size_t piece_size = 1 << 30;         // [bytes] of what is spread; MPI counts by int
constexpr std::chrono::seconds for_the_leader{10};  // to end the run after another process has failed

std::string placeOf(int rank, const std::string& host) {
  return " (process " + std::to_string(rank) + " on " + host + ")";
}

class MpiShare : public ProcessShare {
public:
  MpiShare() {
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &processes_here_);
    MPI_Comm_free(&machine);
    std::string name(MPI_MAX_PROCESSOR_NAME, '\0');
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    host_ = name.substr(0, std::size_t(length));
  }

  bool leads() const override { return rank_ == leader_rank; }
  int processesHere() const override { return processes_here_; }

  void deal(std::size_t count, const Work& work, const Take& take, const Report& report) override {
    if (leads()) {
      dealAsLeader(count, work, take, report);
    } else {
      workForLeader(work, report);
    }
  }

  void spread(std::string& bytes) override {
    std::uint64_t size = bytes.size();
    broadcast(&size, sizeof(size));
    bytes.resize(std::size_t(size));
    for (std::size_t at = 0; at < bytes.size(); at += piece_size) {
      broadcast(bytes.data() + at, std::min(piece_size, bytes.size() - at));
    }
  }

  void hand(const std::string& message, int status) override {
    const std::string bytes = bytesOf(HandedFailure{message + placeOf(rank_, host_), status});
    const auto end = std::chrono::steady_clock::now() + for_the_leader;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(bytes.data(), int(bytes.size()), MPI_BYTE, leader_rank, tag_failure, MPI_COMM_WORLD, &request);
    for (Pause pause; std::chrono::steady_clock::now() < end; pause.sleep()) {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    }
  }

  void abort(int status) override { MPI_Abort(MPI_COMM_WORLD, status); }

  void finish() override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);  // MPI_Finalize() would wait by computing
    await(request, [this] { checkFailures(); });
    MPI_Finalize();
  }

private:
  void broadcast(void* data, std::size_t size) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(data, int(size), MPI_BYTE, leader_rank, MPI_COMM_WORLD, &request);
    await(request, [this] { checkFailures(); });
  }

  /// @throws Error with what another process has handed to the leader
  void checkFailures() const {
    if (!leads()) return;
    const auto received = receiveBytes(MPI_ANY_SOURCE, tag_failure);
    if (!received) return;
    const auto failure = fromBytes<HandedFailure>(received->second);
    throw Error(failure.status == 2 ? ErrorCode::bad_usage : ErrorCode::bad_data, failure.message);
  }

  void workForLeader(const Work& work, const Report& report) const {
    ItemRequest request;
    for (std::size_t done = 0;; ++done) {
      report(done);
      sendBytes(leader_rank, tag_request, bytesOf(request), [] {});
      Pause pause;
      auto answer = receiveBytes(leader_rank, tag_item);
      while (!answer) {
        pause.sleep();
        answer = receiveBytes(leader_rank, tag_item);
      }
      request.item = fromBytes<std::int64_t>(answer->second);
      if (request.item == no_more) return;
      request.result = work(std::size_t(request.item));
    }
  }

  void dealAsLeader(std::size_t count, const Work& work, const Take& take, const Report& report) const {
    std::map<std::size_t, std::string> results;  // that wait for earlier ones
    std::vector<int> waiting;                    // processes
    std::size_t next = 0, taken = 0;
    int others = size_ - 1;  // that were not told that there is no more
    LocalWorker here(work);
    Pause pause;
    while (taken < count || others > 0) {
      checkFailures();
      report(taken);
      bool idle = true;
      while (auto received = receiveBytes(MPI_ANY_SOURCE, tag_request)) {
        auto request = fromBytes<ItemRequest>(received->second);
        if (request.item >= 0) results[std::size_t(request.item)] = std::move(request.result);
        waiting.push_back(received->first);
        idle = false;
      }
      if (auto result = collectHere(here)) {
        results[result->first] = std::move(result->second);
        idle = false;
      }
      for (auto first = results.find(taken); first != results.end(); first = results.find(taken)) {
        const std::string bytes = std::move(first->second);
        results.erase(first);
        take(taken++, bytes);
      }
      const std::size_t end = std::min(count, taken + items_ahead * std::size_t(size_));
      while (!waiting.empty() && (next < end || next == count)) {
        const std::int64_t item = next < end ? std::int64_t(next++) : no_more;
        if (item == no_more) --others;
        sendBytes(waiting.front(), tag_item, bytesOf(item), [this] { checkFailures(); });
        waiting.erase(waiting.begin());
        idle = false;
      }
      if (here.isFree() && next < end) here.give(next++);
      if (idle) {
        pause.sleep();
      } else {
        pause.reset();
      }
    }
  }

  std::optional<LocalWorker::Result> collectHere(LocalWorker& here) const {
    try {
      return here.collect();
    } catch (const Error& error) {
      throw Error(error.code(), error.what() + placeOf(rank_, host_));
    }
  }

  int rank_ = 0, size_ = 1, processes_here_ = 1;
  std::string host_;
};

}  // namespace
}  // namespace sks::tools

extern "C" __attribute__((visibility("default"))) sks::tools::ProcessShare* sksJoinProcesses() {
  static auto* const share = new sks::tools::MpiShare;  // lives until the process ends
  return share;
}
