// SPDX-License-Identifier: BSD-3-Clause
#include "ros/master_access.hpp"

#include <chrono>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/master.h>

namespace sks_detector {
namespace {

/// A port of this machine that takes connections but never says anything; closed at the end.
class SilentPort {
public:
  SilentPort() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size);
    ::listen(socket_, 5);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    number_ = ntohs(address.sin_port);
  }
  ~SilentPort() { close(); }
  SilentPort(const SilentPort&) = delete;
  SilentPort& operator=(const SilentPort&) = delete;

  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  std::uint32_t number() const { return number_; }

private:
  int socket_;
  std::uint32_t number_ = 0;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST(MasterAccess, TheMasterAnswers) {
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(masterAnswers());
  EXPECT_TRUE(answersXmlRpc(ros::master::getHost(), ros::master::getPort(), 10));
  EXPECT_THAT(masterIsAway(), testing::HasSubstr(ros::master::getURI()));
}

TEST(MasterAccess, WhoTakesConnectionsOnlyDoesNotAnswer) {
  SilentPort port;
  auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(answersXmlRpc("127.0.0.1", port.number(), 0.3));
  EXPECT_GE(secondsSince(start), 0.25);
  EXPECT_LT(secondsSince(start), 20);
  port.close();
  EXPECT_FALSE(answersXmlRpc("127.0.0.1", port.number(), 60));  // at once
  EXPECT_LT(secondsSince(start), 40);
}

TEST(MasterAccess, AHostWithoutANameDoesNotAnswer) {
  EXPECT_FALSE(answersXmlRpc("no.such.host.invalid", 11311, 1));
}

}  // namespace sks_detector
