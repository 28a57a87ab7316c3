// SPDX-License-Identifier: BSD-3-Clause
#include "ros/master_access.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <memory>

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ros/master.h>
#include <ros/this_node.h>

namespace sks_detector {
namespace {

using PollClock = std::chrono::steady_clock;

constexpr double longest_answer = 1.0;  // [s]

/// A connection that nothing waits for longer than until a point in time.
class BriefConnection {
public:
  BriefConnection(const addrinfo& address, PollClock::time_point end)
      : socket_(::socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol)),
        end_(end) {
    if (socket_ < 0) return;
    const bool under_way = ::connect(socket_, address.ai_addr, address.ai_addrlen) == 0 || errno == EINPROGRESS;
    int error = 0;
    socklen_t size = sizeof(error);
    connected_ =
        under_way && wait(POLLOUT) && ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
  }
  ~BriefConnection() {
    if (socket_ >= 0) ::close(socket_);
  }
  BriefConnection(const BriefConnection&) = delete;
  BriefConnection& operator=(const BriefConnection&) = delete;

  /// Whether anything comes back; takes all of it. @param request short enough for a buffer
  bool answers(const std::string& request) {
    if (!connected_ || ::send(socket_, request.data(), request.size(), MSG_NOSIGNAL) != ssize_t(request.size())) {
      return false;
    }
    bool answered = false;
    std::array<char, 512> buffer;
    while (wait(POLLIN) && ::recv(socket_, buffer.data(), buffer.size(), 0) > 0) answered = true;  // until it is closed
    return answered;
  }

private:
  bool wait(short events) const {
    pollfd waiting{socket_, events, 0};
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - PollClock::now()).count();
      const int ready = ::poll(&waiting, 1, int(std::max<long>(0, long(left))));
      if (ready >= 0 || errno != EINTR || left <= 0) return ready > 0;
    }
  }

  int socket_;
  PollClock::time_point end_;
  bool connected_ = false;
};

std::string pidRequest(const std::string& host) {
  const std::string body = "<?xml version=\"1.0\"?><methodCall><methodName>getPid</methodName><params><param><value>" +
                           ros::this_node::getName() + "</value></param></params></methodCall>";
  return "POST /RPC2 HTTP/1.0\r\nHost: " + host +
         "\r\nContent-Type: text/xml\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

}  // namespace

bool answersXmlRpc(const std::string& host, std::uint32_t port, double timeout) {
  const auto end =
      PollClock::now() + std::chrono::duration_cast<PollClock::duration>(std::chrono::duration<double>(timeout));
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return false;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next) {
    if (BriefConnection(*address, end).answers(pidRequest(host))) return true;
  }
  return false;
}

bool masterAnswers() {
  return answersXmlRpc(ros::master::getHost(), ros::master::getPort(), longest_answer);
}

std::string masterIsAway() {
  return "the master at " + ros::master::getURI() + " does not answer";
}

}  // namespace sks_detector
