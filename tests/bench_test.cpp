/// `maggic bench` as its user meets it. What comes out is measured, so only its shape is tested.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using testing::Folder;
using ::testing::HasSubstr;
using testing::Program;
using testing::ProgramResult;
using testing::text_of;
using Json = nlohmann::json;

void expect_measured(const Json& figures) {
  const double min = figures.at("min");
  const double p50 = figures.at("p50");
  const double p99 = figures.at("p99");
  EXPECT_GT(min, 0.0);
  EXPECT_LE(min, p50);
  EXPECT_LE(p50, p99);
}

class BenchTest : public ::testing::Test {
 protected:
  ProgramResult bench(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "bench");
    return Program(folder_.path(), std::move(arguments)).wait();
  }

  std::string picture(int width, int height) const {
    const auto bytes = static_cast<std::size_t>(3 * width * height);
    return folder_.write("picture.ppm", "P6 " + std::to_string(width) + " " +
                                            std::to_string(height) + " 255\n" +
                                            std::string(bytes, '('));
  }

  Folder folder_;
  const std::string json_file_ = folder_.file("bench.json");
};

TEST_F(BenchTest, MeasuresTheShippedPipelineWhenNoneIsNamed) {
  const auto result = bench({"--frames", "3", "--threads", "2", "--json", json_file_});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("maggic_3v3"), HasSubstr("3 frames of 640 × 480"),
                                HasSubstr("floor"), HasSubstr("pixels → detections"),
                                HasSubstr("gray_threshold 60 → 61"), HasSubstr("throughput")));
  const Json json = Json::parse(text_of(json_file_));
  EXPECT_EQ(json.at("schema"), "maggic-bench-1");
  for (const char* key :
       {"floor_cold_ms", "plain_table_ms", "pixels_to_blobs_ms", "pixels_to_detections_ms",
        "table_compile_ms", "table_compile_threads_ms", "table_update_ms", "memcpy_16mib_ms"}) {
    SCOPED_TRACE(key);
    expect_measured(json.at(key));
  }
  for (const char* key : {"segment_ms", "blobs_ms", "track_ms"}) {
    SCOPED_TRACE(key);
    expect_measured(json.at("stages").at(key));
  }
  expect_measured(json.at("latency").at("capture_to_detection_ms"));
  for (const char* key : {"plain_table", "segment", "blobs", "track", "pixels_to_blobs",
                          "pixels_to_detections", "floor_cold"}) {
    SCOPED_TRACE(key);
    EXPECT_GT(json.at("ratios_to_floor").at(key), 0.0);
    EXPECT_GT(json.at("ns_per_pixel").at(key), 0.0);
  }
  EXPECT_EQ(json.at("ratios_to_floor").at("floor_cold"), 1.0);
  EXPECT_GT(json.at("throughput").at("one_thread_fps"), 0.0);
  EXPECT_GT(json.at("throughput").at("threads_fps"), 0.0);
  EXPECT_GT(json.at("throughput").at("pipelines_fps"), 0.0);
  EXPECT_EQ(json.at("frame_size_px"), Json({640, 480}));
  EXPECT_EQ(json.at("frames"), 3);
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_GT(json.at("a_frame").at("runs"), 0.0);
  EXPECT_EQ(json.at("a_frame").at("robots"), 6.0);
  EXPECT_FALSE(json.at("machine").at("cpu").get<std::string>().empty());
}

TEST_F(BenchTest, AStillIsRepeatedAndSaysSo) {
  const auto result = bench({"legacy_3v3", "--source", picture(64, 48), "--frames", "4",
                             "--threads", "1", "--json", json_file_});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 frames of 64 × 48"));
  EXPECT_THAT(result.out, HasSubstr("picture.ppm (1 of them distinct)"));
  const Json json = Json::parse(text_of(json_file_));
  EXPECT_EQ(json.at("frames"), 4);
  EXPECT_EQ(json.at("frames_from_source"), 1);
  expect_measured(json.at("pixels_to_detections_ms"));
}

TEST_F(BenchTest, LeavesThePipelinesOwnOutputsAlone) {
  const std::string pipeline =
      folder_.write("pipeline.yaml",
                    "source: {synthetic_match: {width: 64, height: 48}}\n"
                    "normalizer: weighted\n"
                    "segmenter: {hue_pivots: {pivots: {orange: 14, blue: 160}}}\n"
                    "tracker: two_tag\n"
                    "sinks: [{jsonl: {path: precious.jsonl}}]\n");
  folder_.write("precious.jsonl", "the last match");
  const auto result = bench({pipeline, "--frames", "2", "--threads", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(text_of(folder_.file("precious.jsonl")), "the last match");
}

TEST_F(BenchTest, AnUnknownPipelineIsAnsweredWithTheKnownOnes) {
  const auto result = bench({"maggic_9v9"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("maggic_9v9"), HasSubstr("maggic_3v3")));
  EXPECT_EQ(result.out, "");
}

TEST_F(BenchTest, MistakesInAPipelineGiveTwoWithTheirPlaces) {
  const std::string bad = folder_.write("bad.yaml", "source: synthetic_match\ntracker: two_tags\n");
  const auto result = bench({bad});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr(bad + ":2:10: "));
}

TEST_F(BenchTest, ASourceThatIsNotThereGivesTwo) {
  const auto result = bench({"--source", folder_.file("gone.mp4")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--source"), HasSubstr("gone.mp4")));
}

TEST_F(BenchTest, ASourceThatGivesNoFrameGivesOne) {
  const auto result = bench({"--source", folder_.write("empty.mp4", ""), "--json", json_file_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("empty.mp4"));
  EXPECT_FALSE(std::filesystem::exists(json_file_));
}

TEST_F(BenchTest, AReportThatCannotBeWrittenGivesTwoBeforeAnythingIsMeasured) {
  const auto nowhere = bench({"--json", folder_.file("nowhere/bench.json")});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, AllOf(HasSubstr("--json"), HasSubstr("does not exist")));
  EXPECT_EQ(nowhere.out, "");
  const std::string still = picture(8, 8);
  const std::string before = text_of(still);
  const auto over_source = bench({"--source", still, "--json", still});
  EXPECT_EQ(over_source.exit_code, 2);
  EXPECT_EQ(text_of(still), before);
}

TEST_F(BenchTest, NumbersOutOfRangeAreUsageMistakes) {
  for (const auto& arguments : {std::vector<std::string>{"--frames", "0"},
                                {"--frames", "many"},
                                {"--threads", "0"},
                                {"--threads", "1.5"}}) {
    const auto result = bench(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[1];
    EXPECT_THAT(result.err, HasSubstr("found '" + arguments[1] + "', expected a whole number"));
  }
}

}  // namespace
}  // namespace maggic
