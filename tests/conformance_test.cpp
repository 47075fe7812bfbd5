/// Every plugin keeps the contract of its kind, and the suite that says so notices broken ones.

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "maggic/testing.hpp"

namespace maggic {

/// How GoogleTest names the plugin in a failure; found by argument-dependent lookup.
static void PrintTo(const PluginInfo& plugin, std::ostream* stream) { *stream << plugin.name; }

namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

/// Where plugins that need files find and leave them; gone when the program ends.
class Workspace {
 public:
  Workspace() { fs::create_directories(root_ / "pictures"); }
  ~Workspace() { fs::remove_all(root_); }

  std::string path(const std::string& name) const { return (root_ / name).string(); }

  /// Three small pictures, each of another gray.
  std::string pictures() const {
    for (int i = 0; i < 3; ++i) {
      std::ofstream picture(root_ / "pictures" / fmt::format("{}.ppm", i), std::ios::binary);
      picture << "P6 8 6 255\n" << std::string(8 * 6 * 3, static_cast<char>(40 * i));
    }
    return path("pictures");
  }

  /// A few frames, written by the project's own sink.
  std::string clip() const {
    const std::string file = path("clip.mp4");
    const auto sink = testing::make<Sink>("overlay_video", fmt::format("path: '{}'", file));
    const Field field(FieldParameters{}, cv::Size(64, 48));
    sink->open({testing::standard_palette(), {false, 5, 30.0}});
    for (int i = 0; i < 5; ++i) {
      FrameResult result;
      result.frame.sequence = static_cast<std::uint64_t>(i);
      result.frame.captured = std::chrono::milliseconds(33 * i);
      result.frame.bgr = cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i));
      sink->write(result, field);
    }
    sink->close();
    return file;
  }

 private:
  fs::path root_ = fs::path(::testing::TempDir()) / fmt::format("conformance_{}", ::getpid());
};

/// What a plugin needs to work at all; most need nothing.
std::string parameters_of(const std::string& plugin, const Workspace& workspace) {
  const std::map<std::string, std::function<std::string()>> table = {
      {"camera", [] { return std::string("device: 4321"); }},  // one that is not there
      // Packets stay on this machine, at the port whose service throws away what it gets.
      {"fira", [] { return std::string("{address: 127.0.0.1, port: 9}"); }},
      {"images", [&] { return fmt::format("path: '{}'", workspace.pictures()); }},
      {"jsonl", [&] { return fmt::format("path: '{}'", workspace.path("out.jsonl")); }},
      {"labelled_images", [&] { return fmt::format("path: '{}'", workspace.path("set")); }},
      {"overlay_video", [&] { return fmt::format("path: '{}'", workspace.path("out.mp4")); }},
      {"ssl_tracked", [] { return std::string("{address: 127.0.0.1, port: 9}"); }},
      {"ssl_vision", [] { return std::string("{address: 127.0.0.1, port: 9}"); }},
      {"synthetic_match", [] { return std::string("frames: 12"); }},
      {"yuv_boxes",
       [] { return std::string("boxes: {orange: {y: [0, 255], u: [0, 127], v: [140, 255]}}"); }},
      {"video", [&] { return fmt::format("path: '{}'", workspace.clip()); }},
  };
  const auto found = table.find(plugin);
  return found == table.end() ? "" : found->second();
}

class Conformance : public ::testing::TestWithParam<PluginInfo> {};

TEST_P(Conformance, KeepsTheContractOfItsKind) {
  const Workspace workspace;
  const PluginInfo& plugin = GetParam();
  EXPECT_THAT(
      testing::check_conformance(plugin.kind, plugin.name, parameters_of(plugin.name, workspace)),
      IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(EveryPlugin, Conformance,
                         ::testing::ValuesIn(PluginRegistry().scan().plugins),
                         [](const auto& plugin) { return plugin.param.name; });

TEST(Plugins, AreAllAccepted) {
  const PluginRegistry::Scan scan = PluginRegistry().scan();
  EXPECT_FALSE(scan.plugins.empty());
  for (const PluginRefusal& refusal : scan.refused) {
    ADD_FAILURE() << refusal.file << ": " << refusal.reason;
  }
}

/// The plugins under tests/plugins/.
class BrokenPlugin : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { testing::registry().add_folder(MAGGIC_TEST_PLUGIN_DIR); }
};

TEST_F(BrokenPlugin, NoneOfThisIsSaidOfOneThatIsWell) {
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "well_behaved"), IsEmpty());
}

TEST_F(BrokenPlugin, NormalizerThatDependsOnTheBatch) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "batch_dependent_normalizer"),
              AllOf(Contains("a batch of 16 differs from the same colours one at a time"),
                    Contains("a batch of 1000 differs from the same colours one at a time"),
                    Contains("two instances on two threads disagree with one thread")));
}

TEST_F(BrokenPlugin, NormalizerThatWritesBeyondTheEnd) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "overrunning_normalizer"),
              AllOf(Contains("a batch of 17 was written beyond its ends"),
                    Not(Contains("a batch of 16 was written beyond its ends"))));
}

TEST_F(BrokenPlugin, NormalizerThatRemembers) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "remembering_normalizer"),
              AllOf(Contains(HasSubstr("a batch of 255 answered differently the second time")),
                    Contains("two calls of one instance on two threads disagree with one thread")));
}

TEST_F(BrokenPlugin, NormalizerThatIgnoresPaddedRows) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "unpadded_normalizer"),
              AllOf(Contains("a picture of 3×5 was written beyond the ends of its rows"),
                    Contains("a picture of 65×33 was written beyond the ends of its rows")));
}

TEST_F(BrokenPlugin, SegmenterWithLabelsOutOfThePalette) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSegmenter, "foreign_label_segmenter"),
              ElementsAre("label 200 was written, expected labels below the palette's size 10"));
}

TEST_F(BrokenPlugin, NormalizerWithBoundsThatAreTooNarrow) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "narrow_bounds_normalizer"),
              ElementsAre(AllOf(StartsWith("the bounds of B "), HasSubstr(", but B "))));
}

TEST_F(BrokenPlugin, NormalizerWhoseBoundsHoldForCubesAlone) {
  EXPECT_THAT(testing::check_conformance(StageKind::kNormalizer, "cubes_only_normalizer"),
              ElementsAre(AllOf(StartsWith("the bounds of B "), HasSubstr(", but B "))));
}

TEST_F(BrokenPlugin, SegmenterThatTakesOneColorForAllOfABox) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSegmenter, "hasty_segmenter"),
              ElementsAre(AllOf(StartsWith("label_of gives B "), HasSubstr("but segment gives B "))));
}

TEST_F(BrokenPlugin, SegmenterThatLeavesPixelsUnwritten) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSegmenter, "forgetful_segmenter"),
              Contains("two instances on two threads disagree on a picture of 17×9, or left pixels "
                       "unwritten"));
}

TEST_F(BrokenPlugin, TrackerThatBreaksEveryPromise) {
  EXPECT_THAT(
      testing::check_conformance(StageKind::kTracker, "careless_tracker"),
      UnorderedElementsAre(
          "sequence and capture time of the input were not passed on",
          "id 1 occurs more than once in team yellow", "id 1 occurs more than once in team blue",
          "a robot has a number that is not finite", "a robot has a confidence outside (0, 1]",
          "one blob belongs to two objects",
          "the robots are not in order: blue before yellow, ids ascending, unknown last",
          "two instances on two threads disagree, or what `out` held before shows"));
}

TEST_F(BrokenPlugin, SourceThatBreaksEveryPromise) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSource, "restless_source"),
              UnorderedElementsAre("after kEnd a read said something else, expected kEnd again",
                                   "the capture time went backwards",
                                   "opened again it gave other pictures, or it keeps the host's "
                                   "buffer"));
}

TEST_F(BrokenPlugin, SourceThatKeepsTheHostsPicture) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSource, "hoarding_source"),
              ElementsAre("opened again it gave other pictures, or it keeps the host's buffer"));
}

TEST_F(BrokenPlugin, SinkThatFailsOnAnEmptyFrame) {
  EXPECT_THAT(testing::check_conformance(StageKind::kSink, "demanding_sink"),
              UnorderedElementsAre("opening and closing without a frame threw: nothing was written",
                                   "writing a frame in which nothing was found threw: no robots",
                                   "writing after frames were dropped threw: no robots"));
}

TEST_F(BrokenPlugin, DescriptionWithEveryMistake) {
  EXPECT_THAT(
      testing::check_conformance(StageKind::kSink, "ill_described_sink"),
      AllOf(Contains("key 'Queue Length' is declared, expected lower-case letters, digits "
                     "and _"),
            Contains("parameter 'port' has no meaning"), Contains("key 'rate' is declared twice"),
            Contains("parameter 'rate' is 500 by default, expected a value within its "
                     "range 0 … 100"),
            Contains("its parameters are refused: parameters:1:1: rate: is too much")));
}

TEST_F(BrokenPlugin, OneThatCannotBeMadeOrIsMissing) {
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "throwing_constructor"),
              ElementsAre(AllOf(StartsWith("making the stage threw: "),
                                HasSubstr("the camera club has the key"))));
  EXPECT_THAT(testing::check_conformance(StageKind::kTracker, "no_such_plugin"),
              ElementsAre(HasSubstr("there is no plugin 'no_such_plugin'")));
}

}  // namespace
}  // namespace maggic
