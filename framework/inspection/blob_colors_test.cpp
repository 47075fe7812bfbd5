#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maggic/border_check.hpp"

namespace maggic {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A frame of one colour with one blob over its left half.
FrameResult frame_of(std::uint8_t blue, cv::Size size = {4, 2}) {
  FrameResult result;
  result.frame.bgr = cv::Mat(size, CV_8UC3, cv::Scalar(blue, 20, 30));
  Blob blob;
  blob.label = 1;
  blob.bounds_px = {0, 0, size.width / 2, size.height};
  blob.area_px = blob.bounds_px.area();
  for (int row = 0; row < size.height; ++row) {
    const auto y = static_cast<std::uint16_t>(row);
    result.runs.push_back({y, 0, static_cast<std::uint16_t>(size.width / 2), 1});
    result.runs.push_back(
        {y, static_cast<std::uint16_t>(size.width / 2), static_cast<std::uint16_t>(size.width), 2});
  }
  result.blobs.push_back(blob);
  return result;
}

TEST(BlobColors, CountsThePixelsOfBlobsAlone) {
  BlobColors colors;
  colors.offer(frame_of(7));
  const auto counts = colors.counts();
  ASSERT_THAT(counts, SizeIs(1));
  EXPECT_EQ(counts[0].b, 7);
  EXPECT_EQ(counts[0].g, 20);
  EXPECT_EQ(counts[0].r, 30);
  EXPECT_EQ(counts[0].pixels, 4U);
}

TEST(BlobColors, KeepsFramesSpreadOverAllThatWereOffered) {
  BlobColors colors;
  for (int i = 0; i < 100; ++i) colors.offer(frame_of(static_cast<std::uint8_t>(i)));
  const auto counts = colors.counts();
  ASSERT_THAT(counts, SizeIs(7));
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i].b, 16 * i);
}

TEST(BlobColors, LooksAtAPartOfLargeBlobs) {
  BlobColors colors;
  colors.offer(frame_of(7, {1000, 100}));
  ASSERT_THAT(colors.counts(), SizeIs(1));
  EXPECT_LE(colors.counts()[0].pixels, BlobColors::kMaxPixels);
  EXPECT_GT(colors.counts()[0].pixels, BlobColors::kMaxPixels / 2);
}

TEST(BlobColors, HasNoneWithoutFrames) { EXPECT_THAT(BlobColors().counts(), IsEmpty()); }

}  // namespace
}  // namespace maggic
