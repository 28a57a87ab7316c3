// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <QObject>
#include <QTimer>

#include <ros/node_handle.h>
#include <ros/service_client.h>

#include "ros/master_access.hpp"

namespace sks_detector {

/// A call that is under way, as its thread and the window see it. Safe to use from both.
class CallState {
public:
  /// From now on abandon() drops the connection of `client`; false where the call was abandoned before.
  bool attach(const ros::ServiceClient& client);
  void abandon();

  void setEnded();
  bool waitForEnd(std::chrono::steady_clock::time_point until);

private:
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  ros::ServiceClient client_;
  bool abandoned_ = false;
  bool ended_ = false;
};

/// Lets what may block run in threads of its own, and brings its results back to the thread of the window, in which all
/// functions are to be called. Every call is answered exactly once within its bound, unless abandonAll() comes first.
/// The destructor waits for at most a second: threads that hang still are left to end by themselves, and touch nothing
/// of the window.
class AsyncCalls : public QObject {
public:
  using Clock = std::chrono::steady_clock;
  using Then = std::function<void()>;            ///< is run in the thread of the window
  using Work = std::function<Then(CallState&)>;  ///< is run in a thread of its own; should not throw

  AsyncCalls();
  ~AsyncCalls() override;

  /// @param name for refresh()
  /// @param bound longest time without refresh()
  /// @param late instead of the result where it takes longer than that
  void run(const std::string& name, Work work, std::chrono::milliseconds bound, Then late);

  /// Calls a service, whose name is the call's. @param done gets the reply, or in words why there is none
  template <typename Service>
  void call(const std::string& service, const typename Service::Request& request, std::chrono::milliseconds bound,
            std::function<void(const std::string& failure, const typename Service::Response& response)> done);

  /// There is a sign of life: the bounds of the calls of this name begin anew.
  void refresh(const std::string& name);
  /// Nobody waits for the running calls any more: they are not answered.
  void abandonAll();

private:
  /// How threads reach the window as long as there is one.
  struct Mailbox {
    std::mutex mutex;
    QObject* receiver = nullptr;
  };
  struct Running {
    std::string name;
    std::shared_ptr<CallState> state;
    std::thread thread;
    Then late;
    std::chrono::milliseconds bound{0};
    Clock::time_point deadline;
    bool answered = false;
  };

  void finish(const std::shared_ptr<CallState>& state, const Then& then);
  void checkDeadlines();

  std::shared_ptr<Mailbox> mailbox_ = std::make_shared<Mailbox>();
  std::list<Running> running_;
  QTimer timer_;
};

/// "/detector/train did not answer within 10 s: ..."
std::string lateText(const std::string& service, std::chrono::milliseconds bound);
/// Why a call brought no reply, although it was not late.
std::string noServiceText(const std::string& service);
std::string noReplyText(const std::string& service);

template <typename Service>
void AsyncCalls::call(const std::string& service, const typename Service::Request& request,
                      std::chrono::milliseconds bound,
                      std::function<void(const std::string&, const typename Service::Response&)> done) {
  using Response = typename Service::Response;
  const ros::NodeHandle handle;  // made here: the last one to go would shut ROS down
  const auto work = [=](CallState& state) -> Then {
    auto response = std::make_shared<Response>();
    std::string failure;
    try {
      ros::NodeHandle own = handle;
      ros::ServiceClient client;
      // only a persistent connection can be dropped from outside, where the node does not answer
      const bool master = masterAnswers();
      if (master) client = own.serviceClient<Service>(service, true);
      typename Service::Request own_request = request;
      if (!master) {
        failure = masterIsAway();
      } else if (!client.isValid()) {
        failure = noServiceText(service);
      } else if (!state.attach(client) || !client.call(own_request, *response)) {
        failure = noReplyText(service);
      }
    } catch (const std::exception& error) {  // of roscpp, such as a name that it does not allow
      failure = service + ": " + error.what();
    }
    return [=] { done(failure, *response); };
  };
  run(service, work, bound, [=] { done(lateText(service, bound), Response()); });
}

}  // namespace sks_detector
