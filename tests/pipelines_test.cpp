/// Every pipeline and calibration that is shipped: valid, and explained line by line.

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "maggic/pipeline_builder.hpp"
#include "maggic/runner.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

const std::filesystem::path kPipelines = std::filesystem::path(MAGGIC_SOURCE_DIR) / "pipelines";

std::vector<std::string> yaml_files(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

/// The first line that holds configuration without a comment at its end or right above it.
std::string uncommented_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  bool explained_above = false;
  for (std::string line; std::getline(stream, line);) {
    const auto start = line.find_first_not_of(' ');
    const bool is_comment = start != std::string::npos && line[start] == '#';
    const bool is_blank = start == std::string::npos;
    if (!is_comment && !is_blank && !explained_above && line.find(" # ") == std::string::npos) {
      return line;
    }
    explained_above = is_comment;
  }
  return {};
}

class Shipped : public ::testing::TestWithParam<std::string> {};

TEST_P(Shipped, PipelineIsValidAndEveryLineIsCommented) {
  const std::filesystem::path file = kPipelines / (GetParam() + ".yaml");
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = file;
  const BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  EXPECT_NE(built.pipeline, nullptr);
  EXPECT_THAT(reporter.messages(), ::testing::IsEmpty());
  EXPECT_EQ(uncommented_line(file), "");
}

INSTANTIATE_TEST_SUITE_P(Pipelines, Shipped, ::testing::ValuesIn(yaml_files(kPipelines)),
                         [](const auto& test) { return test.param; });

class ShippedCalibration : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedCalibration, FitsAPipelineAndEveryLineIsCommented) {
  const std::filesystem::path file = kPipelines / "calibrations" / (GetParam() + ".yaml");
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = kPipelines / "maggic_3v3.yaml";
  request.calibration = file;
  EXPECT_NO_THROW(build_pipeline(request, testing::registry(), reporter));
  EXPECT_EQ(uncommented_line(file), "");
}

INSTANTIATE_TEST_SUITE_P(Calibrations, ShippedCalibration,
                         ::testing::ValuesIn(yaml_files(kPipelines / "calibrations")),
                         [](const auto& test) { return test.param; });

/// maggic_3v3.yaml with one section replaced, as a file of its own.
std::filesystem::path with_section(const std::string& section, const Node& value) {
  Node document = load_document(kPipelines / "maggic_3v3.yaml");
  *document.find(section) = value;
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) /
      fmt::format("maggic_{}_{}.yaml", section, static_cast<long>(getpid()));
  std::ofstream(file) << to_yaml(document);
  return file;
}

struct FewFrames {
  std::string segmenter;
  std::string tracker;
  ColorTable table;
  std::uint64_t robots_with_id = 0;
};

FewFrames run_few_frames(const std::filesystem::path& file) {
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = file;
  BuiltPipeline built = build_pipeline(request, testing::registry(), reporter);
  FewFrames result{built.pipeline->parts().segmenter.name, built.pipeline->parts().tracker.name,
                   *built.pipeline->color_table(), 0};
  const std::atomic<bool> stop{false};
  run(built, {.max_frames = 20}, stop, reporter, [&](const FrameResult& frame, const RunSummary&) {
    for (const RobotDetection& robot : frame.detections.robots) {
      result.robots_with_id += robot.id != kUnknownId;
    }
  });
  return result;
}

TEST(SwappingAStage, ChangesTheMethodByEditingTheFileAlone) {
  const Node boxes = *load_document(kPipelines / "legacy_3v3.yaml").find("segmenter");
  const FewFrames original = run_few_frames(kPipelines / "maggic_3v3.yaml");
  const FewFrames other_segmenter = run_few_frames(with_section("segmenter", boxes));
  const FewFrames other_tracker =
      run_few_frames(with_section("tracker", parse_document("three_tag", "test")));

  EXPECT_EQ(original.segmenter, "hue_pivots");
  EXPECT_EQ(original.robots_with_id, 20u * 6u);
  EXPECT_EQ(other_segmenter.segmenter, "yuv_boxes");
  EXPECT_FALSE(other_segmenter.table == original.table);
  EXPECT_EQ(other_tracker.tracker, "three_tag");
  EXPECT_TRUE(other_tracker.table == original.table);
  EXPECT_EQ(other_tracker.robots_with_id, 0u) << "no robot of this match wears three tags";
}

}  // namespace
}  // namespace maggic
