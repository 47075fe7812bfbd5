/// From pipeline files to pipelines, with the real plugins.

#include "maggic/pipeline_builder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr std::string_view kPipeline =
    "source: synthetic_match\n"
    "segmenter: {hue_pivots: {gray_threshold: 60}}\n"
    "tracker: two_tag\n";

class PipelineBuilder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "maggic_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(std::string_view name, std::string_view text) {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file) << text;
    return file;
  }

  PipelineRequest request(std::string_view pipeline = kPipeline) {
    PipelineRequest made;
    made.pipeline = write("pipeline.yaml", pipeline);
    return made;
  }

  BuiltPipeline build(const PipelineRequest& request) {
    return build_pipeline(request, testing::registry(), reporter_);
  }

  /// Without the folder, which is another one in every run.
  std::vector<std::string> mistakes(const PipelineRequest& request) {
    std::vector<std::string> told;
    try {
      build(request);
    } catch (const ConfigError& e) {
      for (const Mistake& m : e.mistakes()) told.push_back(without_folder(m));
    }
    return told;
  }
  std::vector<std::string> mistakes(std::string_view pipeline) {
    return mistakes(request(pipeline));
  }

  std::string without_folder(const Mistake& mistake) const {
    const std::string text = mistake.to_string();
    const std::string prefix = folder_.string() + "/";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  }

  /// What `request` comes to at `section`, as YAML.
  std::string merged(const PipelineRequest& request, std::string_view section) {
    std::vector<Mistake> notes;
    const Node document = merged_document(request, notes);
    const Node* node = document.find(section);
    return node == nullptr ? "absent" : to_yaml(*node);
  }

  std::filesystem::path folder_;
  testing::RecordingReporter reporter_;
};

TEST_F(PipelineBuilder, MakesEveryStageTheFileNames) {
  const BuiltPipeline built =
      build(request(std::string(kPipeline) + "palette: {teal: [0, 128, 129]}\n"
                                             "normalizer: weighted\n"
                                             "field: {length_mm: 2000}\n"
                                             "blobs: {max_blobs: 12}\n"
                                             "sinks: [{jsonl: {path: '-'}}]\n"));
  ASSERT_NE(built.pipeline, nullptr);
  const PipelineParts& parts = built.pipeline->parts();
  EXPECT_EQ(built.source.name, "synthetic_match");
  EXPECT_EQ(parts.normalizer.name, "weighted");
  EXPECT_EQ(parts.segmenter.name, "hue_pivots");
  EXPECT_EQ(parts.tracker.name, "two_tag");
  ASSERT_EQ(built.sinks.size(), 1u);
  EXPECT_EQ(built.sinks[0].name, "jsonl");
  EXPECT_EQ(parts.field.length_mm, 2000);
  EXPECT_EQ(parts.blobs.max_blobs, 12);
  const auto teal = parts.palette.find("teal");
  ASSERT_TRUE(teal.has_value());
  EXPECT_EQ(parts.palette.display_color(*teal), (DisplayColor{0, 128, 129}));
  EXPECT_THAT(built.notes, IsEmpty());
}

TEST_F(PipelineBuilder, NeedsNoNormalizerAndNoSinks) {
  const BuiltPipeline built = build(request());
  EXPECT_EQ(built.pipeline->parts().normalizer.name, "none");
  EXPECT_THAT(built.sinks, IsEmpty());
}

TEST_F(PipelineBuilder, MakesTheStagesOfTheFramePathAlone) {
  const PipelineParts parts = build_parts(request(), testing::registry(), reporter_);
  EXPECT_EQ(parts.normalizer.name, "none");
  EXPECT_EQ(parts.segmenter.name, "hue_pivots");
  EXPECT_NE(parts.tracker.stage, nullptr);
  EXPECT_THROW(build_parts(request("source: synthetic_match\nsegmenter: hue_pivots\n"),
                           testing::registry(), reporter_),
               ConfigError);
}

TEST_F(PipelineBuilder, GivesStagesWhatOutlivesTheirMoving) {
  BuiltPipeline built = build(request());
  BuiltPipeline elsewhere = std::move(built);
  built = build(request());
  elsewhere.source.stage->open();
  Frame frame;
  EXPECT_EQ(elsewhere.source.stage->read(frame), ReadStatus::kFrame);
}

TEST_F(PipelineBuilder, RefusesFilesThatAreNoPipeline) {
  EXPECT_THAT(mistakes("- a\n"), ElementsAre(StartsWith("pipeline.yaml:1:1: found a list, expected "
                                                        "a pipeline with the sections palette")));
  EXPECT_THAT(mistakes(""), ElementsAre(StartsWith("pipeline.yaml:1:1: found nothing, expected")));
  PipelineRequest missing;
  missing.pipeline = folder_ / "missing.yaml";
  missing.calibration = folder_;
  EXPECT_THAT(mistakes(missing), ElementsAre(StartsWith("missing.yaml: found no such file"),
                                             HasSubstr(": found a directory")));
}

TEST_F(PipelineBuilder, ACalibrationForAnotherPluginMayTakeKeysAway) {
  PipelineRequest request;
  request.pipeline = std::filesystem::path(MAGGIC_SOURCE_DIR) / "pipelines" / "legacy_3v3.yaml";
  request.calibration = folder_ / "venue.yaml";
  std::ofstream(*request.calibration)
      << "segmenter: {hue_pivots: {pivots: {red: 3, magenta: ~}}}\n";
  EXPECT_THAT(mistakes(request), IsEmpty());
}

TEST_F(PipelineBuilder, TellsTheMistakesOfAllSectionsAtOnce) {
  EXPECT_THAT(
      mistakes("palette: {teal: [0, 128], Teal: [0, 0, 0], background: [1, 1, 1]}\n"
               "plugins: [no_such_folder]\n"
               "source: {synthetic_match: {seeed: 3}}\n"
               "segmenter: {hue_pivots: {gray_threshold: 300}}\n"
               "trakcer: two_tag\n"
               "field: {length_mm: long}\n"
               "blobs: [1]\n"
               "sinks: [{jsonl: {}}, no_such_sink, {a: ~, b: ~}]\n"),
      ElementsAre(
          "pipeline.yaml: missing section 'tracker', expected a tracker plugin by name",
          "pipeline.yaml:1:17: teal: found a list of 2, expected a list of 3 numbers",
          HasSubstr(":1:27: colour name 'Teal'"), HasSubstr(":1:44: colour name 'background'"),
          AllOf(StartsWith("pipeline.yaml:2:11: plugins: found no folder '"),
                EndsWith("no_such_folder', expected one with plugins")),
          StartsWith("pipeline.yaml:3:28: unknown key 'seeed', did you mean 'seed'?"),
          "pipeline.yaml:4:42: gray_threshold: 300 is out of range, expected an integer from 0 to "
          "255",
          "pipeline.yaml:5:1: unknown section 'trakcer', did you mean 'tracker'? (known: palette, "
          "plugins, source, normalizer, segmenter, field, blobs, light, scan, tracker, sinks)",
          StartsWith("pipeline.yaml:6:20: length_mm: found 'long', expected a number from"),
          "pipeline.yaml:7:8: found a list, expected a map of parameters",
          StartsWith("pipeline.yaml:8:17: path: missing, expected text"),
          HasSubstr(":8:22: there is no plugin 'no_such_sink'"),
          "pipeline.yaml:8:36: sink: found 2 plugins (a, b), expected one sink plugin by name"));
}

TEST_F(PipelineBuilder, TellsAPluginThatDoesNotFitAtThePlaceThatNamesIt) {
  EXPECT_THAT(mistakes("source: synthetic_match\n"
                       "segmenter: two_tag\n"
                       "tracker: [two_tag]\n"
                       "sinks: {jsonl: {path: x}}\n"),
              ElementsAre(AllOf(StartsWith("pipeline.yaml:2:12: plugin 'two_tag'"),
                                EndsWith("is a tracker, expected a segmenter")),
                          "pipeline.yaml:3:10: tracker: found a list, expected one tracker plugin "
                          "by name",
                          "pipeline.yaml:4:8: sinks: found a map, expected a list of sinks"));
}

class UnwillingStage : public PipelineBuilder {
 protected:
  UnwillingStage() {
    std::vector<std::filesystem::path> folders = PluginRegistry::default_folders();
    folders.emplace_back(MAGGIC_TEST_PLUGIN_DIR);
    registry_ = PluginRegistry(folders);
  }

  PluginRegistry registry_;
};

TEST_F(UnwillingStage, IsAMistakeAtThePlaceThatNamesIt) {
  const PipelineRequest r = request(
      "source: synthetic_match\n"
      "segmenter: hue_pivots\n"
      "tracker: refusing_tracker\n");
  try {
    build_pipeline(r, registry_, reporter_);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(without_folder(e.mistakes().front()),
              "pipeline.yaml:3:10: tracker 'refusing_tracker' failed to prepare: nobody plays in "
              "the rain");
  }
}

TEST_F(UnwillingStage, WarnsUnderItsName) {
  const BuiltPipeline built =
      build_pipeline(request("source: synthetic_match\n"
                             "segmenter: hue_pivots\n"
                             "tracker: {refusing_tracker: {refuse: false}}\n"),
                     registry_, reporter_);
  EXPECT_THAT(reporter_.messages(), ElementsAre("tracker 'refusing_tracker': the grass is wet"));
}

TEST_F(PipelineBuilder, AppliesAssignmentsToBareNamesToo) {
  PipelineRequest r = request();
  r.assignments = {"source.synthetic_match.seed=3", "tracker=three_tag", "field.length_mm=1600"};
  EXPECT_EQ(merged(r, "source"), "synthetic_match:\n  seed: 3\n");
  EXPECT_EQ(merged(r, "tracker"), "three_tag: ~\n");
  EXPECT_EQ(build(r).pipeline->parts().field.length_mm, 1600);
}

TEST_F(PipelineBuilder, TellsMistakesInAssignmentsTogetherWithTheOthers) {
  PipelineRequest r = request("source: synthetic_match\nsegmenter: hue_pivots\n");
  r.assignments = {"nonsense", "segmenter.hue_pivots.gray_threshold=900",
                   "source.synthetic_match.seed.x.y=1", "source.synthetic_match.seed=two"};
  EXPECT_THAT(mistakes(r),
              ElementsAre("--set:1:1: found 'nonsense', expected path.to.key=value",
                          StartsWith("--set:1:29: seed: found 'two', expected an integer from 0"),
                          "--set:1:37: gray_threshold: 900 is out of range, expected an integer "
                          "from 0 to 255",
                          HasSubstr("pipeline.yaml: missing section 'tracker'")));
}

TEST_F(PipelineBuilder, ReplacesTheSourceOrAddsToItsParameters) {
  PipelineRequest r = request("source: {synthetic_match: {seed: 1, frames: 5}}\n");
  r.source = parse_document("{synthetic_match: {seed: 2}}", "--source");
  EXPECT_EQ(merged(r, "source"), "synthetic_match:\n  seed: 2\n  frames: 5\n");
  r.source = parse_document("synthetic_match", "--source");
  EXPECT_EQ(merged(r, "source"), "synthetic_match:\n  seed: 1\n  frames: 5\n");
  r.source = parse_document("{video: {path: a.mp4}}", "--source");
  EXPECT_EQ(merged(r, "source"), "video:\n  path: a.mp4\n");
}

TEST_F(PipelineBuilder, AddsSinksToThePipelines) {
  PipelineRequest r = request(std::string(kPipeline) + "sinks: [jsonl]\n");
  r.extra_sinks.push_back(parse_document("{jsonl: {path: a}}", "--output"));
  EXPECT_EQ(merged(r, "sinks"), "-\n  jsonl: ~\n-\n  jsonl:\n    path: a\n");
}

TEST_F(PipelineBuilder, LaysACalibrationOverThePluginsThatRun) {
  PipelineRequest r = request(std::string(kPipeline) +
                              "field: {length_mm: 1500, half_time: true}\n"
                              "sinks: [{jsonl: {path: a}}]\n");
  r.calibration = write("venue.yaml",
                        "segmenter:\n"
                        "  hue_pivots: {gray_threshold: 30}\n"
                        "  yuv_boxes: {boxes: {red: {y: [0, 9], u: [0, 9], v: [0, 9]}}}\n"
                        "normalizer: weighted\n"
                        "tracker:\n"
                        "field: {length_mm: 1510}\n"
                        "sinks: [{jsonl: {path: b}}]\n");
  EXPECT_EQ(merged(r, "segmenter"), "hue_pivots:\n  gray_threshold: 30\n");
  EXPECT_EQ(merged(r, "field"), "length_mm: 1510\nhalf_time: true\n");
  EXPECT_EQ(merged(r, "sinks"), "-\n  jsonl:\n    path: b\n");
  const BuiltPipeline built = build(r);
  EXPECT_EQ(built.pipeline->parts().segmenter.name, "hue_pivots");
  EXPECT_EQ(built.pipeline->parts().normalizer.name, "none");
  ASSERT_EQ(built.notes.size(), 2u);
  EXPECT_EQ(without_folder(built.notes[0]),
            "venue.yaml:3:3: calibration for segmenter 'yuv_boxes' is not used: the pipeline runs "
            "'hue_pivots'");
  EXPECT_EQ(without_folder(built.notes[1]),
            "venue.yaml:4:13: calibration for normalizer 'weighted' is not used: the pipeline runs "
            "'none'");
}

TEST_F(PipelineBuilder, ChecksCalibrationBlocksThatAreNotUsed) {
  PipelineRequest r = request();
  r.calibration = write("venue.yaml",
                        "segmenter: {yuv_boxes: {gray_treshold: 3}}\n"
                        "tracker: [two_tag]\n"
                        "filed: {length_mm: 1}\n");
  EXPECT_THAT(mistakes(r),
              ElementsAre(StartsWith("venue.yaml:1:25: unknown key 'gray_treshold'"),
                          "venue.yaml:2:10: found a list, expected plugins with their parameters",
                          StartsWith("venue.yaml:3:1: unknown section 'filed', did you mean "
                                     "'field'?")));
}

TEST_F(PipelineBuilder, NotesACalibrationForAPluginThatIsNotThere) {
  PipelineRequest r = request();
  r.calibration = write("venue.yaml", "segmenter: {team_secret: {a: 1}}\n");
  const BuiltPipeline built = build(r);
  ASSERT_EQ(built.notes.size(), 1u);
  EXPECT_THAT(built.notes[0].message,
              HasSubstr("the pipeline runs 'hue_pivots'; not checked: there is no plugin "
                        "'team_secret'"));
}

TEST_F(PipelineBuilder, KeepsTheRequestedSourceAboveTheCalibration) {
  PipelineRequest r = request();
  r.calibration = write("venue.yaml", "source: {video: {path: venue.mp4, loop: true}}\n");
  r.source = parse_document("{video: {path: mine.mp4}}", "--source");
  EXPECT_EQ(merged(r, "source"), "video:\n  path: mine.mp4\n  loop: true\n");
}

TEST_F(PipelineBuilder, LooksForPluginsInFoldersBesideThePipelineFile) {
  std::filesystem::create_directory(folder_ / "mine");
  write("mine/fake.so", "not a library");
  PluginRegistry registry(std::vector<std::filesystem::path>{});
  try {
    build_pipeline(request("plugins: [mine]\nsource: fake\nsegmenter: fake\ntracker: fake\n"),
                   registry, reporter_);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr((folder_ / "mine" / "fake.so").string()));
  }
}

}  // namespace
}  // namespace maggic
