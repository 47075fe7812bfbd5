/// `maggic import` as its user meets it.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

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

constexpr const char* kSession = "Maggic\n17 82\n78\n-1 4\n43 3\n97 5\n140 7\n151 2\n235 6\n";
constexpr const char* kBoxes =
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n"
    "<Orange><YMAX>200</YMAX><UMAX>86</UMAX><VMAX>255</VMAX>"
    "<YMIN>81</YMIN><UMIN>29</UMIN><VMIN>172</VMIN></Orange>\n"
    "<Blue><YMAX>125</YMAX><UMAX>230</UMAX><VMAX>132</VMAX>"
    "<YMIN>0</YMIN><UMIN>159</UMIN><VMIN>77</VMIN></Blue>\n"
    "<GrayScale>50</GrayScale>\n</opencv_storage>\n";
constexpr const char* kLimits =
    "{\n\t\"point1\": {\"x\": 65, \"y\": 37},\n\t\"point2\": {\"x\": 54, \"y\": 443},\n"
    "\t\"point3\": {\"x\": 576, \"y\": 448},\n\t\"point4\": {\"x\": 575, \"y\": 52}\n}\n";

class ImportTest : public ::testing::Test {
 protected:
  ProgramResult maggic(std::vector<std::string> arguments) {
    return Program(folder_.path(), std::move(arguments)).wait();
  }
  bool is_written() const { return std::filesystem::exists(output_); }

  Folder folder_;
  const std::string session_ = folder_.write("MaggicSegmentation.txt", kSession);
  const std::string boxes_ = folder_.write("Default.xml", kBoxes);
  const std::string limits_ = folder_.write("fieldLimits.json", kLimits);
  const std::string output_ = folder_.file("venue.yaml");
};

TEST_F(ImportTest, MergesWhatItIsGivenIntoACalibrationThatRuns) {
  const auto result =
      maggic({"import", session_, boxes_, limits_, "-o", output_, "--image-size", "640x480"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("6 pivots of 6 colours for hue_pivots"),
                    HasSubstr("2 boxes for yuv_boxes"), HasSubstr("four corners for field")));
  EXPECT_THAT(text_of(output_),
              AllOf(HasSubstr("gray_threshold: 78"), HasSubstr("red: 255"),
                    HasSubstr("gray_threshold: 49"), HasSubstr("image_size_px: [640, 480]")));
  const std::string pipelines = std::string(MAGGIC_SOURCE_DIR) + "/pipelines/";
  const auto checked = maggic({"check", pipelines + "maggic_3v3.yaml",
                               pipelines + "legacy_3v3.yaml", "--calibration", output_});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

TEST_F(ImportTest, ReportsEveryBrokenFileAndWritesNothing) {
  const std::string broken = folder_.write("broken.txt", "Maggic\n17 82\nx\n");
  const std::string other = folder_.write("other.xml", "<opencv_storage><Navy/></opencv_storage>");
  const auto result = maggic({"import", broken, other, folder_.file("missing"), "-o", output_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("broken.txt:3:1: found 'x', expected a gray threshold"),
                                HasSubstr("other.xml:1:17: found '<Navy/>"),
                                HasSubstr("missing: found no such file"), HasSubstr("3 mistakes")));
  EXPECT_FALSE(is_written());
}

TEST_F(ImportTest, NeverWritesOverWhatItReads) {
  const auto result = maggic({"import", session_, "-o", session_});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("would destroy what is imported"));
  EXPECT_EQ(text_of(session_), kSession);
}

TEST_F(ImportTest, RefusesAPictureSizeThatMeansNothing) {
  for (const char* size : {"640", "640x", "0x480", "640x480x3", "99999x1"}) {
    const auto result = maggic({"import", limits_, "-o", output_, "--image-size", size});
    EXPECT_EQ(result.exit_code, 2) << size;
    EXPECT_THAT(result.err, HasSubstr("expected WIDTHxHEIGHT in pixels"));
  }
  const auto without = maggic({"import", session_, "-o", output_, "--image-size", "640x480"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("none of the files has corners"));
  EXPECT_FALSE(is_written());
}

TEST_F(ImportTest, FailsWhereItCannotWrite) {
  const auto result = maggic({"import", session_, "-o", folder_.file("no/such/folder.yaml")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("folder.yaml"));
}

}  // namespace
}  // namespace maggic
