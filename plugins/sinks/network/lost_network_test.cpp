/// A network that is really down and comes up again: that of a process which has one of its own.

#include <chrono>
#include <cstring>
#include <functional>

#include <gmock/gmock.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/wait.h>

#include "maggic/testing.hpp"
#include "network/persistent_sender.hpp"
#include "network/udp_receiver_for_tests.hpp"
#include "network/udp_socket.hpp"

namespace maggic::network {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;

constexpr int kNotAllowed = 77;

/// In a process whose only network interface, `lo`, is down. @return false when none may be made.
bool without_network(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) ::_exit(kNotAllowed);
    body();
    ::_exit(::testing::Test::HasFailure() ? 1 : 0);
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotAllowed) return false;
  EXPECT_EQ(status, 0) << "see what the process said above";
  return true;
}

void switch_network_on() {
  const int any_socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  request.ifr_flags = IFF_UP;
  EXPECT_EQ(::ioctl(any_socket, SIOCSIFFLAGS, &request), 0);
  ::close(any_socket);
}

TEST(LostNetwork, IsToldOfOnceAndUsedAgainWhenItIsBack) {
  const auto body = [] {
    UdpReceiver client(true);
    testing::RecordingReporter reporter;
    PersistentSender sender(std::make_unique<UdpSocket>(UdpSettings{
                                .address = "127.0.0.1", .port = client.port(), .interface = {}}),
                            reporter);
    const PersistentSender::Moment start{std::chrono::hours(5)};
    for (int frame = 0; frame < 250; ++frame) {
      EXPECT_FALSE(sender.send("lost", start + milliseconds(10 * frame)));
    }
    switch_network_on();
    EXPECT_TRUE(sender.send("found", start + seconds(3)));
    EXPECT_EQ(client.receive(), "found");
    const std::string gone = "nothing is sent, to 127.0.0.1:" + std::to_string(client.port()) +
                             ": Network is unreachable; trying again every second";
    EXPECT_THAT(reporter.messages(), ElementsAre(gone, "packets are sent again after 3.0 s"));
  };
  if (!without_network(body)) GTEST_SKIP() << "no process may have a network of its own here";
}

TEST(LostNetwork, HasNoRouteToAMulticastGroup) {
  const auto body = [] {
    testing::RecordingReporter reporter;
    PersistentSender sender(
        std::make_unique<UdpSocket>(UdpSettings{.address = "224.5.23.2", .port = 10015}), reporter);
    EXPECT_FALSE(sender.send("lost"));
    EXPECT_THAT(reporter.messages(),
                ElementsAre("nothing is sent, to 224.5.23.2:10015: Network is unreachable; trying "
                            "again every second"));
  };
  if (!without_network(body)) GTEST_SKIP() << "no process may have a network of its own here";
}

}  // namespace
}  // namespace maggic::network
