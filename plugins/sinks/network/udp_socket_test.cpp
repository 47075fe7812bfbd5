#include "network/udp_socket.hpp"

#include <chrono>

#include <gmock/gmock.h>

#include "network/udp_receiver_for_tests.hpp"

namespace maggic::network {
namespace {

using ::testing::HasSubstr;

class SendingDatagrams : public ::testing::Test {
 protected:
  UdpReceiver client_;
  UdpSettings settings_{.address = "127.0.0.1", .port = client_.port()};
};

TEST_F(SendingDatagrams, ReachesOneMachine) {
  UdpSocket socket(settings_);
  ASSERT_EQ(socket.open(), std::nullopt);
  EXPECT_FALSE(socket.send("first"));
  EXPECT_FALSE(socket.send("second"));
  EXPECT_EQ(client_.receive(), "first");
  EXPECT_EQ(client_.receive(), "second");
}

TEST_F(SendingDatagrams, TakesAnInterfaceByNameOrByAddress) {
  for (const char* interface : {"lo", "127.0.0.1"}) {
    settings_.interface = interface;
    UdpSocket socket(settings_);
    ASSERT_EQ(socket.open(), std::nullopt) << interface;
    EXPECT_FALSE(socket.send(interface));
    EXPECT_EQ(client_.receive(), interface);
  }
}

TEST_F(SendingDatagrams, ReachesAMulticastGroup) {
  const std::string group = "239.255.37.11";  // not routed beyond an organisation
  UdpReceiver member(true);
  if (!member.join(group)) GTEST_SKIP() << "this system has no multicast on its own interface";
  settings_ = {.address = group, .port = member.port(), .interface = "lo", .ttl = 0};
  UdpSocket socket(settings_);
  ASSERT_EQ(socket.open(), std::nullopt);
  EXPECT_FALSE(socket.send("to all"));
  EXPECT_EQ(member.receive(), "to all");
}

TEST_F(SendingDatagrams, SaysWhichInterfaceIsNotThere) {
  for (const char* interface : {"no_such_card", "203.0.113.9"}) {  // reserved for examples
    settings_.interface = interface;
    UdpSocket socket(settings_);
    EXPECT_EQ(socket.open(), "there is no network interface '" + std::string(interface) + "'");
  }
}

TEST_F(SendingDatagrams, CountsAPacketNobodyListensToAsSent) {
  int port = 0;
  {
    const UdpReceiver gone;
    port = gone.port();
  }
  settings_.port = port;
  UdpSocket socket(settings_);
  ASSERT_EQ(socket.open(), std::nullopt);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(socket.send("anybody?"));
}

TEST_F(SendingDatagrams, RefusesAPacketNoDatagramHolds) {
  UdpSocket socket(settings_);
  ASSERT_EQ(socket.open(), std::nullopt);
  const std::optional<Refusal> refusal = socket.send(std::string(70'000, 'x'));
  ASSERT_TRUE(refusal);
  EXPECT_THAT(refusal->reason, HasSubstr("to 127.0.0.1:" + std::to_string(settings_.port)));
  EXPECT_FALSE(refusal->passing);
}

TEST_F(SendingDatagrams, SendsAgainAfterBeingClosed) {
  UdpSocket socket(settings_);
  ASSERT_EQ(socket.open(), std::nullopt);
  socket.close();
  EXPECT_TRUE(socket.send("closed"));
  ASSERT_EQ(socket.open(), std::nullopt);
  EXPECT_FALSE(socket.send("open"));
  EXPECT_EQ(client_.receive(), "open");
}

}  // namespace
}  // namespace maggic::network
