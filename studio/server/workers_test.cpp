/// Few threads for many connections.

#include "studio/server/workers.hpp"

#include <sys/socket.h>

#include <atomic>
#include <latch>

#include <gtest/gtest.h>

namespace maggic::studio {
namespace {

Socket some_socket() { return Socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)); }

TEST(WorkersTest, ServeEveryConnectionBeforeTheyEnd) {
  std::atomic<int> served{0};
  {
    Workers workers(3, [&served](Socket socket) { served += socket ? 1 : 0; });
    for (int i = 0; i < 100; ++i) workers.add(some_socket());
  }
  EXPECT_EQ(served, 100);
}

TEST(WorkersTest, ServeAsManyAtOnceAsThereMayBeThreads) {
  // Nobody gets past the latch unless three are there at once.
  std::latch together(3);
  Workers workers(3, [&together](Socket) { together.arrive_and_wait(); });
  for (int i = 0; i < 3; ++i) workers.add(some_socket());
}

TEST(WorkersTest, AreCrowdedWhileConnectionsWait) {
  std::latch begun(1);
  std::latch end(1);
  Workers workers(1, [&](Socket) {
    if (!begun.try_wait()) begun.count_down();
    end.wait();
  });
  workers.add(some_socket());
  begun.wait();
  EXPECT_FALSE(workers.crowded());
  workers.add(some_socket());
  EXPECT_TRUE(workers.crowded());
  end.count_down();
}

}  // namespace
}  // namespace maggic::studio
