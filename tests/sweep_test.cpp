/// `maggic sweep` and `maggic plot normalizer` from outside.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "../framework/report/xml_for_tests.hpp"
#include "maggic/palette.hpp"
#include "program.hpp"

namespace maggic {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;
using testing::text_of;

class Pictures : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(set()); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path set() const { return folder_ / "set"; }
  fs::path out() const { return folder_ / "out"; }

  ProgramResult maggic(std::vector<std::string> arguments) const {
    return Program(folder_, std::move(arguments)).wait();
  }
  ProgramResult sweep(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"sweep",        "maggic_3v3", "--images",
                                       set().string(), "-o",         out().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return maggic(std::move(arguments));
  }

  static cv::Mat row(const std::vector<cv::Vec3b>& pixels) {
    return cv::Mat(pixels, true).reshape(3, 1);
  }
  static cv::Mat labels(std::initializer_list<int> values) {
    cv::Mat picture(1, static_cast<int>(values.size()), CV_8UC1);
    std::ranges::copy(values, picture.ptr<Label>());
    return picture;
  }
  void write(const std::string& name, const cv::Mat& picture) const {
    ASSERT_TRUE(cv::imwrite((set() / name).string(), picture));
  }
  /// Two red pixels with channels 100 and 60 steps apart, two of background 30 and 0 apart.
  void write_sample() const {
    write("a.png", row({{0, 0, 100}, {0, 0, 60}, {0, 0, 30}, {50, 50, 50}}));
    write("a.labels.png", labels({4, 4, 0, 0}));
  }

  /// Cells of the CSV by normalizer and threshold.
  std::map<std::string, std::string> csv_rows() const {
    std::map<std::string, std::string> rows;
    std::istringstream text(text_of(out() / "sweep.csv"));
    for (std::string line; std::getline(text, line);) {
      const std::size_t end = line.find(',', line.find(',') + 1);
      rows[line.substr(0, end)] = line.substr(std::min(end, line.size() - 1) + 1);
    }
    return rows;
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / fmt::format("maggic_sweep_{}", ::getpid());
};

using Sweep = Pictures;
using PlotNormalizer = Pictures;

TEST_F(Sweep, GivesTheSharesOfAPictureWorkedOutByHand) {
  write_sample();
  const ProgramResult result = sweep({"--normalizers", "none"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto rows = csv_rows();
  EXPECT_EQ(rows.size(), 257u);
  EXPECT_EQ(rows["normalizer,gray_threshold"], "background_percent,red_percent");
  EXPECT_EQ(rows["none,0"], "50.000,100.000");
  EXPECT_EQ(rows["none,29"], "50.000,100.000");
  EXPECT_EQ(rows["none,30"], "100.000,100.000");
  EXPECT_EQ(rows["none,59"], "100.000,100.000");
  EXPECT_EQ(rows["none,60"], "100.000,50.000");
  EXPECT_EQ(rows["none,100"], "100.000,0.000");
  EXPECT_THAT(result.out, AllOf(HasSubstr("30 … 59"), HasSubstr("1 picture, 4 distinct")));
}

TEST_F(Sweep, TheShareSaysHowManyPixelsAGoodThresholdKeeps) {
  write_sample();
  EXPECT_THAT(sweep({"--normalizers", "none", "--share", "50"}).out,
              AllOf(HasSubstr("ALL ≥ 50 %"), HasSubstr("0 … 99")));
}

TEST_F(Sweep, ComparesEveryColourNormalizerUnlessToldWhich) {
  write_sample();
  const ProgramResult result = sweep();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string name : {"none", "chromatic", "vector", "weighted", "sweep"}) {
    EXPECT_TRUE(XmlReader::read(text_of(out() / (name + ".svg")))) << name;
  }
  EXPECT_EQ(csv_rows().size(), 4 * 256 + 1u);
}

TEST_F(Sweep, TakesTheSegmentersOtherParametersFromThePipeline) {
  write_sample();
  const auto red_at_0 = [&](const std::string& assignment) {
    EXPECT_EQ(sweep({"--normalizers", "none", "--set", assignment}).exit_code, 0);
    return csv_rows()["none,0"];
  };
  EXPECT_EQ(red_at_0("segmenter.hue_pivots.pivots={red: 252}"), "50.000,100.000");
  EXPECT_EQ(red_at_0("segmenter.hue_pivots.pivots={blue: 252}"), "50.000,0.000");
}

TEST_F(Sweep, WorksForEverySegmenterWithAGrayThreshold) {
  write_sample();
  const ProgramResult result = maggic({"sweep", "legacy_3v3", "--images", set().string(), "-o",
                                       out().string(), "--normalizers", "none"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(csv_rows()["none,255"], "100.000,0.000");
}

TEST_F(Sweep, ReadsLabelsDrawnInThePalettesColours) {
  write_sample();
  write("a.labels.png", row({{20, 20, 230}, {20, 20, 230}, {0, 0, 0}, {0, 0, 0}}));
  ASSERT_EQ(sweep({"--normalizers", "none"}).exit_code, 0);
  EXPECT_EQ(csv_rows()["none,60"], "100.000,50.000");
}

TEST_F(Sweep, LeavesOutPicturesWithoutLabelsAndSaysSo) {
  write_sample();
  write("b.png", row({{1, 2, 3}}));
  const ProgramResult result = sweep({"--normalizers", "none"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("1 of 2 pictures have no labels"));
}

TEST_F(Sweep, RefusesWhatIsNoLabelledPicture) {
  const auto refused = [&](const std::string& why) {
    const ProgramResult result = sweep();
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(out())) << "nothing is written";
  };
  refused("no picture found in");
  write("a.png", row({{1, 2, 3}, {1, 2, 3}}));
  refused("none with labels beside it: expected for a.png a file a.labels.png");
  write("a.labels.png", labels({0}));
  refused("the labels are 1 x 1, the picture is 2 x 1");
  write("a.labels.png", labels({0, 99}));
  refused("gray value 99 at x 1, y 0 is no label");
  write("a.labels.png", row({{9, 9, 9}, {0, 0, 0}}));
  refused("the colour 9 9 9");
  std::ofstream(set() / "a.labels.png") << "no picture";
  refused("a.labels.png': it is no picture");
  fs::remove_all(set());
  refused("no picture found in");
}

TEST_F(Sweep, RefusesStagesItCannotVary) {
  write_sample();
  const ProgramResult unknown = sweep({"--normalizers", "wieghted"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("wieghted"), HasSubstr("weighted")));
  const ProgramResult other_kind = sweep({"--normalizers", "jsonl"});
  EXPECT_EQ(other_kind.exit_code, 2);
  EXPECT_EQ(sweep({"--share", "101"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Sweep, SaysWhenItCannotWrite) {
  write_sample();
  std::ofstream(out()) << "a file";
  const ProgramResult result = sweep();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot make the folder"));
}

TEST_F(PlotNormalizer, DrawsOneArrowAtLeastForEveryPlane) {
  const fs::path file = folder_ / "weighted.svg";
  const ProgramResult result = maggic({"plot", "normalizer", "weighted", "-o", file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto elements = XmlReader::read(text_of(file));
  ASSERT_TRUE(elements);
  EXPECT_GT(std::ranges::count(*elements, "polygon", &XmlElement::name), 100);
  EXPECT_LT(fs::file_size(file), 120'000u);
}

TEST_F(PlotNormalizer, ListsTheKnownOnesForAnUnknownOne) {
  const ProgramResult result = maggic({"plot", "normalizer", "nothing_such"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("nothing_such"), HasSubstr("weighted")));
  EXPECT_FALSE(fs::exists("nothing_such.svg"));
}

TEST_F(PlotNormalizer, RefusesAPluginOfAnotherKindAndAFileItCannotWrite) {
  EXPECT_EQ(maggic({"plot", "normalizer", "hue_pivots"}).exit_code, 2);
  const ProgramResult result =
      maggic({"plot", "normalizer", "none", "-o", (folder_ / "no/such/file.svg").string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no/such/file.svg"));
}

}  // namespace
}  // namespace maggic
