/// Shipped pipelines with hand-made calibrations on recorded footage. The footage is not part of
/// the project; where `../shared/footage` is absent these tests say so and skip.

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "maggic/runner.hpp"
#include "maggic/scorecard.hpp"
#include "maggic/testing.hpp"
#include "maggic/truth_file.hpp"

namespace maggic {
namespace {

const std::filesystem::path kProject = MAGGIC_SOURCE_DIR;
const std::filesystem::path kFootage = kProject / ".." / "shared" / "footage";

// Sanitizer builds run 20 times slower; they look for memory errors, not for the share of frames.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kMaxFrames = 30;
#else
constexpr std::uint64_t kMaxFrames = 1'000'000;
#endif

struct FootageCase {
  std::string clip;      // <clip>.json and the media it names; also the calibration's name
  std::string pipeline;  // in pipelines/
  std::string source;    // plugin that reads it
  double share_of_frames;
  bool check_headings;
};

void PrintTo(const FootageCase& c, std::ostream* out) { *out << c.clip; }

class Footage : public ::testing::TestWithParam<FootageCase> {};

TEST_P(Footage, EveryObjectIsFoundAndNothingElse) {
  const FootageCase& c = GetParam();
  if (!std::filesystem::exists(kFootage / (c.clip + ".json"))) {
    GTEST_SKIP() << "no footage at " << kFootage;
  }
  const std::filesystem::path annotation = kFootage / (c.clip + ".json");
  PipelineRequest request;
  request.pipeline = kProject / "pipelines" / (c.pipeline + ".yaml");
  request.calibration = kProject / "pipelines" / "calibrations" / (c.clip + ".yaml");
  const Palette palette = Palette::standard();
  request.source =
      parse_document(fmt::format("{}: {{path: '{}'}}", c.source,
                                 (kFootage / load_truth(annotation, palette).media).string()),
                     "test");
  testing::RecordingReporter reporter;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  built.sinks.clear();

  const Truth truth = load_truth(annotation, built.pipeline->palette());
  Scorecard card(truth.tolerance);
  const std::atomic<bool> stop{false};
  const RunSummary summary =
      run(built, {.max_frames = kMaxFrames}, stop, reporter,
          [&](const FrameResult& result, const RunSummary&) {
            ASSERT_EQ(result.frame.bgr.size(), truth.size_px);
            card.add(result.detections, *truth.every_frame, *built.pipeline->field());
          });
  EXPECT_TRUE(summary.clean()) << summary.first_error;
  ASSERT_GT(card.frames(), 0u);
  const ObjectTally robots = card.robots();
  EXPECT_GE(static_cast<double>(card.frames_right()),
            c.share_of_frames * static_cast<double>(card.frames()))
      << card.frames_right() << " of " << card.frames() << " frames right; robots: " << robots.seen
      << " of " << robots.frames << " seen, " << robots.within_tolerance << " near, "
      << robots.right_identity << " rightly named, " << card.false_robots()
      << " false; ball: " << card.ball().seen << " of " << card.ball().frames << " seen, "
      << card.false_balls() << " false";
  if (c.check_headings) {
    EXPECT_LE(robots.heading_deg.quantile(c.share_of_frames), 8.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Clips, Footage,
    ::testing::Values(FootageCase{"static", "maggic_3v3", "video", 0.99, true},
                      FootageCase{"static", "legacy_3v3", "video", 0.99, true},
                      FootageCase{"tags_3v3_0", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"tags_3v3_1", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"all_tags", "maggic_3v3_three_tag", "video", 1.0, true},
                      FootageCase{"rinobot_1", "maggic_3v3", "images", 1.0, true},
                      // This pattern's front is not on the line through its two patches.
                      FootageCase{"vsssdk_model_3908ae", "diagonal_tags", "images", 1.0, false}),
    [](const auto& test) { return test.param.clip + "_" + test.param.pipeline; });

}  // namespace
}  // namespace maggic
