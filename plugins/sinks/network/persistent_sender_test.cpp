#include "network/persistent_sender.hpp"

#include <vector>

#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace maggic::network {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A network that can be cut.
struct Network {
  std::optional<std::string> no_opening;
  std::optional<Refusal> no_sending;
  std::vector<std::string> packets;
  int attempts = 0;
  int opened = 0;
};

class FakeSocket final : public PacketSocket {
 public:
  explicit FakeSocket(Network& network) : network_(network) {}
  std::optional<std::string> open() override {
    if (network_.no_opening) {
      ++network_.attempts;
      return network_.no_opening;
    }
    ++network_.opened;
    return std::nullopt;
  }
  std::optional<Refusal> send(std::string_view packet) override {
    ++network_.attempts;
    if (network_.no_sending) return network_.no_sending;
    network_.packets.emplace_back(packet);
    return std::nullopt;
  }
  void close() override {}

 private:
  Network& network_;
};

class SendingPersistently : public ::testing::Test {
 protected:
  Network network_;
  testing::RecordingReporter reporter_;
  PersistentSender sender_{std::make_unique<FakeSocket>(network_), reporter_};
  const PersistentSender::Moment start_{std::chrono::hours(5)};
};

TEST_F(SendingPersistently, SendsOverOneSocketWhileAllIsWell) {
  EXPECT_TRUE(sender_.send("a", start_));
  EXPECT_TRUE(sender_.send("b", start_ + milliseconds(1)));
  EXPECT_THAT(network_.packets, ElementsAre("a", "b"));
  EXPECT_EQ(network_.opened, 1);
  EXPECT_THAT(reporter_.messages(), IsEmpty());
}

TEST_F(SendingPersistently, WarnsOnceWhenThereIsNoNetworkAndTriesOnceASecond) {
  network_.no_opening = "there is no network interface 'eth9'";
  for (int frame = 0; frame < 300; ++frame) {
    EXPECT_FALSE(sender_.send("late", start_ + milliseconds(10 * frame)));
  }
  EXPECT_EQ(network_.attempts, 3);
  EXPECT_THAT(reporter_.messages(),
              ElementsAre("nothing is sent, there is no network interface 'eth9'; trying again "
                          "every second"));
}

TEST_F(SendingPersistently, OpensAnewAfterAFailureAndSaysWhenItIsBack) {
  EXPECT_TRUE(sender_.send("a", start_));
  network_.no_sending = Refusal{"to 224.5.23.2:10015: Network is unreachable"};
  EXPECT_FALSE(sender_.send("b", start_ + seconds(1)));
  network_.no_sending.reset();
  EXPECT_FALSE(sender_.send("c", start_ + milliseconds(1999))) << "not due yet";
  EXPECT_TRUE(sender_.send("d", start_ + seconds(2)));
  EXPECT_THAT(network_.packets, ElementsAre("a", "d"));
  EXPECT_EQ(network_.opened, 2);
  EXPECT_THAT(reporter_.messages(),
              ElementsAre("nothing is sent, to 224.5.23.2:10015: Network is unreachable; trying "
                          "again every second",
                          "packets are sent again after 1.0 s"));
}

TEST_F(SendingPersistently, TellsOfAnotherReason) {
  network_.no_opening = "one reason";
  sender_.send("a", start_);
  network_.no_opening = "another reason";
  sender_.send("b", start_ + seconds(1));
  EXPECT_THAT(reporter_.messages(),
              ElementsAre("nothing is sent, one reason; trying again every second",
                          "nothing is sent, another reason; trying again every second"));
}

TEST_F(SendingPersistently, LeavesOutOnlyThePacketThatWasOneTooMany) {
  EXPECT_TRUE(sender_.send("a", start_));
  network_.no_sending = Refusal{"to 10.0.0.7:10015: No buffer space available", true};
  EXPECT_FALSE(sender_.send("b", start_ + milliseconds(1)));
  network_.no_sending.reset();
  EXPECT_TRUE(sender_.send("c", start_ + milliseconds(2)));
  EXPECT_THAT(network_.packets, ElementsAre("a", "c"));
  EXPECT_EQ(network_.opened, 1);
  EXPECT_THAT(reporter_.messages(),
              ElementsAre("a packet was left out, to 10.0.0.7:10015: No buffer space available"));
}

}  // namespace
}  // namespace maggic::network
