#include "maggic/frame_store.hpp"

#include <gmock/gmock.h>

#include "pipeline/fake_stages_for_tests.hpp"

namespace maggic {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

cv::Mat gray(int width, int height, double value) {
  return cv::Mat(height, width, CV_8UC3, cv::Scalar::all(value));
}

/// A source whose frame n is filled with the value n.
class FrameStoreTest : public ::testing::Test {
 protected:
  FrameStoreTest() {
    source_->picture = [](std::uint64_t n) { return gray(8, 6, static_cast<double>(n)); };
  }

  FrameStore take(const FrameStore::Limits& limits) {
    return {rig_.built.source, limits, rig_.reporter};
  }

  static int value_at(const FrameStore& store, std::uint64_t i) {
    Frame frame;
    store.get(i, frame);
    return frame.bgr.at<cv::Vec3b>(5, 7)[1];
  }

  fakes::Rig rig_{3};
  fakes::CountingSource* source_ = rig_.source;
};

TEST_F(FrameStoreTest, ReadsNoMoreThanIsWanted) {
  const FrameStore store = take({.frames = 2});
  EXPECT_EQ(store.size(), 2U);
  EXPECT_EQ(store.given(), 2U);
  EXPECT_EQ(source_->given, 2U);
}

TEST_F(FrameStoreTest, RepeatsAShortClipInItsOrderWithTimesThatGoOn) {
  const FrameStore store = take({.frames = 5});
  EXPECT_EQ(store.size(), 5U);
  EXPECT_EQ(store.given(), 3U);
  std::vector<int> values;
  for (std::uint64_t i = 0; i < 7; ++i) values.push_back(value_at(store, i));
  EXPECT_THAT(values, ElementsAre(0, 1, 2, 0, 1, 0, 1));
  Frame frame;
  store.get(6, frame);
  EXPECT_EQ(frame.sequence, 6U);
  EXPECT_EQ(frame.captured, milliseconds(60)) << "100 frames a second";
}

TEST_F(FrameStoreTest, GivesEveryFrameMemoryOfItsOwn) {
  source_->picture = [shared = gray(8, 6, 1)](std::uint64_t) { return shared; };
  const FrameStore store = take({.frames = 5});
  Frame first;
  Frame copied;
  store.get(0, first);
  store.get(4, copied);
  EXPECT_NE(first.bgr.data, copied.bgr.data);
}

TEST_F(FrameStoreTest, KeepsFewerFramesWhereTheyAreLarge) {
  EXPECT_EQ(take({.frames = 300, .bytes = std::size_t{2 * 8 * 6 * 3}}).size(), 2U);
}

TEST_F(FrameStoreTest, KeepsOneFrameHoweverLarge) {
  EXPECT_EQ(take({.frames = 300, .bytes = 1}).size(), 1U);
}

TEST_F(FrameStoreTest, PassesOverWhatIsNoPictureOrOfAnotherSize) {
  source_->count = 4;
  source_->picture = [](std::uint64_t n) {
    if (n == 1) return cv::Mat();
    return n == 2 ? gray(9, 6, 2) : gray(8, 6, static_cast<double>(n));
  };
  const FrameStore store = take({.frames = 10});
  EXPECT_EQ(store.given(), 2U);
  EXPECT_EQ(value_at(store, 1), 3);
  EXPECT_THAT(rig_.reporter.messages(),
              ElementsAre(HasSubstr("it is empty"), HasSubstr("another size")));
}

TEST_F(FrameStoreTest, ConvertsAsTheFramePathDoes) {
  source_->picture = [](std::uint64_t) { return cv::Mat(6, 8, CV_8UC1, cv::Scalar(9)); };
  EXPECT_EQ(value_at(take({.frames = 1}), 0), 9);
}

TEST_F(FrameStoreTest, WithoutAnyFrameIsAnErrorThatNamesTheSource) {
  source_->count = 0;
  try {
    take({.frames = 1});
    FAIL() << "no frame, no error";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr("no frame ever came from the source 'counting'"));
  }
}

TEST_F(FrameStoreTest, TellsWhichSourceFailed) {
  source_->before_read = [](std::uint64_t n) {
    if (n == 1) throw std::runtime_error("the cable is out");
  };
  try {
    take({.frames = 2});
    FAIL() << "the source failed, no error";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr("source 'counting' failed at frame 1: the cable is out"));
  }
}

}  // namespace
}  // namespace maggic
