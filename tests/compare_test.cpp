/// `maggic compare` as its user meets it.

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Program;
using testing::ProgramResult;
using testing::text_of;
using Json = nlohmann::json;

const fs::path kFootage = fs::path(MAGGIC_SOURCE_DIR) / ".." / "shared" / "footage";

/// A page of a megabyte is nothing to print when a test fails.
bool has(const std::string& page, std::string_view part) { return page.find(part) != page.npos; }

class CompareTest : public ::testing::Test {
 protected:
  ProgramResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return Program(folder_.path(), std::move(arguments)).wait();
  }

  std::vector<std::string> names_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }

  Folder folder_;
  const std::string out_ = folder_.file("out");
};

TEST_F(CompareTest, WritesATableAReportAndEveryFigure) {
  const std::string json_file = folder_.file("compare.json");
  const auto result =
      compare({"maggic_3v3", "legacy_3v3", "--frames", "20", "-o", out_, "--json", json_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("20 frames through 2 pipelines"), HasSubstr("A maggic_3v3"),
                    HasSubstr("B legacy_3v3"), HasSubstr("difference"), HasSubstr("frames_right"),
                    HasSubstr("report: " + out_)));

  const std::string html = text_of(out_ + "/report.html");
  for (const char* part : {"Against the truth", "Where they differ most", "<th>20</th>",
                           "<th>60</th>", "rowspan=\"3\""}) {
    EXPECT_TRUE(has(html, part)) << part;
  }
  for (const char* part : {"<script", "<link", "src=\"http", "href="}) {
    EXPECT_FALSE(has(html, part)) << part;
  }
  for (const std::string& name : names_in(out_)) {
    EXPECT_TRUE(name == "report.html" || name.starts_with("different_frame_")) << name;
  }

  const Json json = Json::parse(text_of(json_file));
  EXPECT_EQ(json.at("schema"), "maggic-compare-1");
  const Json& pipelines = json.at("pipelines");
  ASSERT_EQ(pipelines.size(), 2u);
  EXPECT_EQ(pipelines[0].at("figures").at("seen"), 100.0);
  EXPECT_TRUE(pipelines[0].at("agreement").is_null());
  EXPECT_EQ(pipelines[1].at("agreement").at("identity"), 100.0);
  const double difference = pipelines[1].at("differences").at("position_rmse_mm");
  EXPECT_NEAR(difference,
              pipelines[1].at("figures").at("position_rmse_mm").get<double>() -
                  pipelines[0].at("figures").at("position_rmse_mm").get<double>(),
              2e-6);
}

TEST_F(CompareTest, APipelineAgreesWithItselfWhereTheTruthIsNotKnown) {
  const std::string picture =
      folder_.write("empty.ppm", "P6 640 480 255\n" + std::string(3 * 640 * 480, '('));
  const auto result =
      compare({"maggic_3v3", "maggic_3v3", "--source", picture, "-o", out_, "--thresholds", "30"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("agreement with A maggic_3v3"),
                                HasSubstr("frames_right       100.00 %")));
  const std::string html = text_of(out_ + "/report.html");
  EXPECT_FALSE(has(html, "Against the truth"));
  EXPECT_FALSE(has(html, "differ most"));
}

TEST_F(CompareTest, CalibrationsAreForAllOrOneForEach) {
  const std::string strict =
      folder_.write("strict.yaml", "segmenter: {hue_pivots: {gray_threshold: 255}}\n");
  const std::string plain =
      folder_.write("plain.yaml", "segmenter: {hue_pivots: {gray_threshold: 60}}\n");
  const std::string json_file = folder_.file("compare.json");
  const auto result = compare({"maggic_3v3", "maggic_3v3", "--calibration", plain, "--calibration",
                               strict, "--frames", "3", "-o", out_, "--json", json_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("B maggic_3v3 (strict)"));
  const Json json = Json::parse(text_of(json_file));
  EXPECT_EQ(json.at("pipelines")[0].at("figures").at("seen"), 100.0);
  EXPECT_EQ(json.at("pipelines")[1].at("figures").at("seen"), 0.0);
  EXPECT_EQ(json.at("different_frames")[0].at("objects"), 7);

  const auto wrong = compare({"maggic_3v3", "maggic_3v3", "legacy_3v3", "--calibration", plain,
                              "--calibration", strict, "-o", out_});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--calibration: found 2 for 3 pipelines, expected none"));
}

TEST_F(CompareTest, MistakesAreToldBeforeAnythingRunsOrIsWritten) {
  const std::string truth = folder_.write("bad.json", "{");
  const struct {
    std::vector<std::string> arguments;
    const char* text;
  } cases[] = {
      {{"maggic_3v3"}, "found one pipeline, expected two or more"},
      {{"maggic_3v3", "no_such_pipeline"}, "no_such_pipeline"},
      {{"maggic_3v3", "legacy_3v3", "--truth", truth}, "bad.json:1:"},
      {{"maggic_3v3", "legacy_3v3", "--thresholds", "300"}, "300"},
      {{"maggic_3v3", "legacy_3v3", "--json", folder_.file("no/c.json")}, "does not exist"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> arguments = c.arguments;
    arguments.insert(arguments.end(), {"-o", out_});
    const auto result = compare(arguments);
    EXPECT_EQ(result.exit_code, 2) << c.text;
    EXPECT_THAT(result.err, HasSubstr(c.text));
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_FALSE(fs::exists(out_)) << c.text;
  }
}

TEST_F(CompareTest, NeverReplacesAFolderThatIsNotAnEarlierReport) {
  fs::create_directory(out_);
  folder_.write("out/thesis.tex", "precious");
  const auto result = compare({"maggic_3v3", "legacy_3v3", "--frames", "2", "-o", out_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr(out_), HasSubstr("thesis.tex")));
  EXPECT_EQ(text_of(out_ + "/thesis.tex"), "precious");
}

TEST_F(CompareTest, TheTruthOfAnotherSizeGivesTwoAndLeavesNothing) {
  const std::string truth = folder_.write(
      "truth.json", R"({"size_px": [320, 240], "tolerance_px": 3, "ball": null, "robots": []})");
  const auto result =
      compare({"maggic_3v3", "legacy_3v3", "--truth", truth, "--frames", "2", "-o", out_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("found 320 x 240"));
  for (const std::string& name : names_in(folder_.path())) {
    EXPECT_FALSE(name.starts_with("out")) << name;
  }
}

TEST_F(CompareTest, ComparesOnRecordedFootage) {
  if (!fs::exists(kFootage)) GTEST_SKIP() << "no footage at " << kFootage;
  const std::string clip = kFootage / "static";
  const std::string json_file = folder_.file("compare.json");
  const auto result =
      compare({"maggic_3v3", "legacy_3v3", "--source", clip + ".mp4", "--truth", clip + ".json",
               "--calibration", "static", "--frames", "20", "-o", out_, "--json", json_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(text_of(json_file));
  for (const Json& pipeline : json.at("pipelines")) {
    EXPECT_EQ(pipeline.at("frames").at("judged"), 20);
    EXPECT_EQ(pipeline.at("figures").at("frames_right"), 100.0) << pipeline.at("name");
  }
}

}  // namespace
}  // namespace maggic
