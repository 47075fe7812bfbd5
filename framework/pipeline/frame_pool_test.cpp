#include "maggic/frame_pool.hpp"

#include <thread>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using std::chrono::milliseconds;

TEST(FramePool, GivesEverySlotOnceThenWaits) {
  FramePool pool(2);
  const FramePtr a = pool.acquire(milliseconds(0));
  const FramePtr b = pool.acquire(milliseconds(0));
  ASSERT_TRUE(a && b);
  EXPECT_NE(a, b);
  EXPECT_FALSE(pool.acquire(milliseconds(1)));
}

TEST(FramePool, ASlotComesBackWithItsLastOwnerAndKeepsItsBuffers) {
  FramePool pool(1);
  FramePtr first = pool.acquire(milliseconds(0));
  first->result.frame.bgr.create(4, 6, CV_8UC3);
  const unsigned char* buffer = first->result.frame.bgr.data;
  FramePtr second_owner = first;
  first.reset();
  EXPECT_FALSE(pool.acquire(milliseconds(0)));
  second_owner.reset();
  const FramePtr again = pool.acquire(milliseconds(0));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->result.frame.bgr.data, buffer);
}

TEST(FramePool, GivesSlotsNeverUsedBeforeReturnedOnes) {
  FramePool pool(2);
  const PooledFrame* first = pool.acquire(milliseconds(0)).get();
  const PooledFrame* second = pool.acquire(milliseconds(0)).get();
  EXPECT_NE(second, first);
  EXPECT_EQ(pool.acquire(milliseconds(0)).get(), second) << "the one returned last";
}

TEST(FramePool, AWaitingThreadGetsTheSlotAnotherOneReturns) {
  FramePool pool(1);
  FramePtr held = pool.acquire(milliseconds(0));
  std::thread giver([frame = std::move(held)]() mutable {
    std::this_thread::sleep_for(milliseconds(5));
    frame.reset();
  });
  EXPECT_TRUE(pool.acquire(milliseconds(5000)));
  giver.join();
}

TEST(FramePool, RefusesToBeEmpty) { EXPECT_THROW(FramePool(0), std::invalid_argument); }

}  // namespace
}  // namespace maggic
