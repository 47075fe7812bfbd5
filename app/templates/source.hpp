#pragma once

#include "app/templates/shared.hpp"

namespace maggic::app::templates {

inline constexpr Plugin kSource = {R"cpp(
/// @NAME@: one sentence on where its frames come from
///
/// When to use it. As it stands it gives gray pictures, each a little brighter than the last.
///
///     source:
///       @NAME@:
///         frames: 100

#include "maggic/plugin.hpp"

namespace {

class @CLASS@ final : public maggic::Source {
 public:
  void describe(maggic::Parameters& p) override {
    p.integer({"frames", "how many frames to give"}, frames_, {1, 1'000'000});
    p.number({"fps", "frames a second", "1/s"}, fps_, {1.0, 1000.0});
  }

  maggic::SourceInfo open() override { return {false, static_cast<std::uint64_t>(frames_), fps_}; }

  maggic::ReadStatus read(maggic::Frame& frame) override {
    if (given_ == frames_) return maggic::ReadStatus::kEnd;
    frame.bgr.create(480, 640, CV_8UC3);  // takes the earlier frame's memory where it fits
    frame.bgr.setTo(cv::Scalar::all(given_ % 256));
    frame.captured = std::chrono::nanoseconds(static_cast<std::int64_t>(given_ * 1e9 / fps_));
    ++given_;
    return maggic::ReadStatus::kFrame;
  }

 private:
  int frames_ = 100;
  double fps_ = 60.0;
  int given_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(@CLASS@, "gray pictures that grow brighter")
)cpp",
                                   R"cpp(
#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace {

TEST(@CLASS@, KeepsTheContractOfASource) {
  EXPECT_THAT(
      maggic::testing::check_conformance(maggic::StageKind::kSource, "@NAME@", "frames: 10"),
      ::testing::IsEmpty());
}

TEST(@CLASS@, GivesAsManyFramesAsItWasAskedFor) {
  const auto source = maggic::testing::make<maggic::Source>("@NAME@", "{frames: 3, fps: 10}");
  EXPECT_EQ(source->open().frame_count, 3U);
  maggic::Frame frame;
  int frames = 0;
  while (source->read(frame) == maggic::ReadStatus::kFrame) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_EQ(frame.captured, std::chrono::milliseconds(200));
}

}  // namespace
)cpp"};

}  // namespace maggic::app::templates
