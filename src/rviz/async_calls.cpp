// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/async_calls.hpp"

#include <algorithm>
#include <utility>

#include "core/settings/number_format.hpp"

namespace sks_detector {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds deadline_period{100};
constexpr milliseconds longest_farewell{1000};  // of the destructor

}  // namespace

bool CallState::attach(const ros::ServiceClient& client) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!abandoned_) client_ = client;
  return !abandoned_;
}

void CallState::abandon() {
  ros::ServiceClient client;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    abandoned_ = true;
    std::swap(client, client_);
  }
  client.shutdown();
}

void CallState::setEnded() {
  const std::lock_guard<std::mutex> lock(mutex_);
  client_ = ros::ServiceClient();
  ended_ = true;
  ended_changed_.notify_all();
}

bool CallState::waitForEnd(std::chrono::steady_clock::time_point until) {
  std::unique_lock<std::mutex> lock(mutex_);
  return ended_changed_.wait_until(lock, until, [&] { return ended_; });
}

AsyncCalls::AsyncCalls() {
  mailbox_->receiver = this;
  connect(&timer_, &QTimer::timeout, this, &AsyncCalls::checkDeadlines);
  timer_.start(deadline_period);
}

AsyncCalls::~AsyncCalls() {
  {
    const std::lock_guard<std::mutex> lock(mailbox_->mutex);
    mailbox_->receiver = nullptr;
  }
  abandonAll();
  const Clock::time_point end = Clock::now() + longest_farewell;
  for (Running& call : running_) {
    if (call.state->waitForEnd(end)) {
      call.thread.join();
    } else {
      call.thread.detach();
    }
  }
}

void AsyncCalls::run(const std::string& name, Work work, milliseconds bound, Then late) {
  const auto state = std::make_shared<CallState>();
  auto body = [state, work = std::move(work), mailbox = mailbox_, this] {
    Then then = work(*state);
    {
      const std::lock_guard<std::mutex> lock(mailbox->mutex);
      if (mailbox->receiver) {
        QMetaObject::invokeMethod(
            mailbox->receiver, [this, state, then = std::move(then)] { finish(state, then); }, Qt::QueuedConnection);
      }
    }
    state->setEnded();
  };
  running_.push_back({name, state, std::thread(std::move(body)), std::move(late), bound, Clock::now() + bound, false});
}

void AsyncCalls::refresh(const std::string& name) {
  for (Running& call : running_) {
    if (call.name == name) call.deadline = Clock::now() + call.bound;
  }
}

void AsyncCalls::abandonAll() {
  for (Running& call : running_) {
    call.answered = true;
    call.state->abandon();
  }
}

void AsyncCalls::finish(const std::shared_ptr<CallState>& state, const Then& then) {
  const auto found =
      std::find_if(running_.begin(), running_.end(), [&](const Running& call) { return call.state == state; });
  found->thread.join();  // it has nothing left to do
  const bool answered = found->answered;
  running_.erase(found);
  if (!answered && then) then();
}

void AsyncCalls::checkDeadlines() {
  std::list<Then> late;  // what they do may start other calls
  for (Running& call : running_) {
    if (call.answered || Clock::now() < call.deadline) continue;
    call.answered = true;
    call.state->abandon();
    late.push_back(call.late);
  }
  for (const Then& then : late) {
    if (then) then();
  }
}

std::string lateText(const std::string& service, milliseconds bound) {
  return sks::formatted("%s did not answer within %.0f s: the node may hang or be out of reach; see its log",
                        service.c_str(), std::chrono::duration<double>(bound).count());
}

std::string noServiceText(const std::string& service) {
  return "there is no service " + service + ": is the node running, and is that its name?";
}

std::string noReplyText(const std::string& service) {
  return service + " gave no reply: the node has ended, cannot be reached or is of another version";
}

}  // namespace sks_detector
