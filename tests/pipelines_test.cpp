/// Every pipeline and calibration that is shipped: valid, and explained line by line.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "maggic/pipeline_builder.hpp"
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

TEST(SwappingAStage, ChangesTheMethodWithoutARebuild) {
  testing::RecordingReporter reporter;
  PipelineRequest request;
  request.pipeline = kPipelines / "maggic_3v3.yaml";
  const Node original = load_document(request.pipeline);

  Node other_segmenter = original;
  *other_segmenter.find("segmenter") =
      parse_document("yuv_boxes: {boxes: {red: {y: [0, 255], u: [0, 255], v: [200, 255]}}}", "test");
  Node other_tracker = original;
  *other_tracker.find("tracker") = parse_document("three_tag", "test");

  const BuiltPipeline a = build_pipeline(original, testing::registry(), reporter);
  const BuiltPipeline b = build_pipeline(other_segmenter, testing::registry(), reporter);
  const BuiltPipeline c = build_pipeline(other_tracker, testing::registry(), reporter);
  EXPECT_EQ(a.pipeline->parts().segmenter.name, "hue_pivots");
  EXPECT_EQ(b.pipeline->parts().segmenter.name, "yuv_boxes");
  EXPECT_NE(a.pipeline->color_table()->labels(), b.pipeline->color_table()->labels());
  EXPECT_EQ(c.pipeline->parts().tracker.name, "three_tag");
  EXPECT_EQ(a.pipeline->color_table()->labels(), c.pipeline->color_table()->labels());
}

}  // namespace
}  // namespace maggic
