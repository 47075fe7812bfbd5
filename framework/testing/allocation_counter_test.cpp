#include "testing/allocation_counter.hpp"

#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace maggic::testing {
namespace {

class AllocationCounterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!AllocationCounter::works()) GTEST_SKIP() << "the sanitizer has operator new for itself";
  }
};

/// Keeps the compiler from doing without the memory.
void keep(const void* memory) {
  [[maybe_unused]] static const void* volatile kept;
  kept = memory;
}

TEST_F(AllocationCounterTest, CountsNewInAllItsForms) {
  struct alignas(64) Aligned {
    char bytes[64];
  };
  const AllocationCounter counter;
  const auto one = std::make_unique<int>(1);
  keep(one.get());
  EXPECT_EQ(counter.count(), 1u);
  const std::vector<int> many(100);
  keep(many.data());
  EXPECT_EQ(counter.count(), 2u);
  const auto aligned = std::make_unique<Aligned>();
  keep(aligned.get());
  EXPECT_EQ(counter.count(), 3u);
  const std::unique_ptr<int> if_possible(new (std::nothrow) int(4));
  keep(if_possible.get());
  EXPECT_EQ(counter.count(), 4u);
  const auto array = std::make_unique<int[]>(5);
  keep(array.get());
  EXPECT_EQ(counter.count(), 5u);
  const std::unique_ptr<Aligned[]> aligned_array(new (std::nothrow) Aligned[6]);
  keep(aligned_array.get());
  EXPECT_EQ(counter.count(), 6u);
}

TEST_F(AllocationCounterTest, CountsPicturesButNotSharesOfThem) {
  const AllocationCounter counter;
  cv::Mat picture(4, 5, CV_8UC3);
  const std::uint64_t made = counter.count();
  EXPECT_GE(made, 1u);
  const cv::Mat share = picture;
  picture.create(4, 5, CV_8UC3);
  EXPECT_EQ(counter.count(), made);
  picture.create(5, 5, CV_8UC3);
  EXPECT_GT(counter.count(), made);
}

TEST_F(AllocationCounterTest, TellsItsOwnThreadFromTheOthers) {
  std::uint64_t of_the_other = 0;
  const AllocationCounter counter;
  std::thread other([&] {
    const AllocationCounter own;
    const auto one = std::make_unique<int>(1);
    keep(one.get());
    of_the_other = own.count_of_this_thread();
  });
  other.join();
  EXPECT_EQ(of_the_other, 1u);
  EXPECT_LT(counter.count_of_this_thread(), counter.count());
}

}  // namespace
}  // namespace maggic::testing
