#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <opencv2/imgcodecs.hpp>

#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace {

namespace fs = std::filesystem;
using maggic::Frame;
using maggic::ReadStatus;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

class ImagesSource : public ::testing::Test {
 protected:
  ImagesSource() { fs::create_directories(folder_); }
  ~ImagesSource() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }

  /// A picture whose every value is `value`, to be recognised by.
  void write_picture(const std::string& name, int value, cv::Size size = {16, 12},
                     int type = CV_8UC3) {
    ASSERT_TRUE(cv::imwrite(path(name), cv::Mat(size, type, cv::Scalar::all(value))));
  }

  void write_text(const std::string& name, const std::string& content) {
    std::ofstream(path(name), std::ios::binary) << content;
  }

  void keep_first_bytes(const std::string& name, double part) {
    const double size = static_cast<double>(fs::file_size(path(name)));
    fs::resize_file(path(name), static_cast<std::uintmax_t>(size * part));
  }

  maggic::StagePtr<maggic::Source> source_of(const std::string& file,
                                             const std::string& more = "") {
    auto source = maggic::testing::registry().create<maggic::Source>("images");
    maggic::configure_stage(*source, "{path: '" + file + "'" + more + "}",
                            maggic::testing::standard_palette(), reporter_);
    return source;
  }

  maggic::StagePtr<maggic::Source> opened(const std::string& file, const std::string& more = "") {
    auto source = source_of(file, more);
    source->open();
    return source;
  }

  struct Seen {
    int value;
    milliseconds captured;
    bool operator==(const Seen&) const = default;
  };

  /// The frames up to the end, or `most` of them.
  std::vector<Seen> frames_of(maggic::Source& source, std::size_t most = 100) {
    std::vector<Seen> seen;
    Frame frame;
    while (seen.size() < most) {
      const ReadStatus status = source.read(frame);
      if (status == ReadStatus::kEnd) break;
      if (status == ReadStatus::kFrame) {
        seen.push_back(
            {frame.bgr.ptr(0)[0], std::chrono::duration_cast<milliseconds>(frame.captured)});
      }
    }
    return seen;
  }

  static std::vector<int> values(const std::vector<Seen>& seen) {
    std::vector<int> result;
    for (const Seen& s : seen) result.push_back(s.value);
    return result;
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("images_test_" + std::to_string(::getpid()));
  maggic::testing::RecordingReporter reporter_;
};

TEST_F(ImagesSource, KeepsTheSourceContract) {
  for (int i = 0; i < 4; ++i) write_picture("a" + std::to_string(i) + ".png", 10 * i);
  write_text("a9.png", "no picture");
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSource, "images",
                                                 "{path: '" + folder_.string() + "'}"),
              IsEmpty());
}

TEST_F(ImagesSource, GivesAFoldersPicturesInNaturalOrderAtTheRateAsked) {
  for (const int i : {1, 2, 10}) write_picture("img" + std::to_string(i) + ".png", i);
  auto source = source_of(folder_, ", fps: 100");
  const maggic::SourceInfo info = source->open();
  EXPECT_FALSE(info.live);
  EXPECT_EQ(info.frame_count, 3u);
  EXPECT_EQ(info.frames_per_second, 100.0);
  EXPECT_THAT(frames_of(*source), ElementsAre(Seen{1, milliseconds(0)}, Seen{2, milliseconds(10)},
                                              Seen{10, milliseconds(20)}));
  EXPECT_THAT(reporter_.messages(), IsEmpty());
}

TEST_F(ImagesSource, GivesOneFileWhateverItsName) {
  write_picture("one.png", 7);
  fs::rename(path("one.png"), path("strange [1] name"));
  EXPECT_THAT(values(frames_of(*opened(path("strange [1] name")))), ElementsAre(7));
}

TEST_F(ImagesSource, GivesTheMatchesOfAPattern) {
  fs::create_directories(folder_ / "set[1]" / "sub.png");
  for (const int i : {2, 11, 3}) write_picture("set[1]/b" + std::to_string(i) + ".png", i);
  write_picture("set[1]/c5.png", 5);
  EXPECT_THAT(values(frames_of(*opened(path("set[1]/b*.png")))), ElementsAre(2, 3, 11));
  EXPECT_THAT(values(frames_of(*opened(path("set[1]/?5.png")))), ElementsAre(5));
  EXPECT_THAT(values(frames_of(*opened(path("s*/*.png")))), ElementsAre(2, 3, 11, 5));
}

TEST_F(ImagesSource, AFileNamedLikeAPatternIsThatFile) {
  write_picture("a.png", 1);
  write_picture("b.png", 2);
  fs::rename(path("b.png"), path("*.png"));
  EXPECT_THAT(values(frames_of(*opened(path("*.png")))), ElementsAre(2));
}

TEST_F(ImagesSource, LoopsForEverWhileTimeRunsOn) {
  write_picture("a.png", 1);
  write_picture("b.png", 2);
  auto source = source_of(folder_, ", loop: true, fps: 1000");
  EXPECT_EQ(source->open().frame_count, std::nullopt);
  EXPECT_THAT(frames_of(*source, 5), ElementsAre(Seen{1, milliseconds(0)}, Seen{2, milliseconds(1)},
                                                 Seen{1, milliseconds(2)}, Seen{2, milliseconds(3)},
                                                 Seen{1, milliseconds(4)}));
}

TEST_F(ImagesSource, PassesGrayAlpha16BitAndOddSizesOnToTheHost) {
  write_picture("1.png", 50, {1, 1}, CV_8UC1);
  write_picture("2.png", 50, {7, 13}, CV_8UC4);
  write_picture("3.png", 50 * 257, {33, 5}, CV_16UC3);
  write_picture("4.png", 50 * 257, {5, 3}, CV_16UC1);
  auto source = opened(folder_);
  Frame frame;
  std::vector<cv::Size> sizes;
  std::vector<int> depths;
  while (source->read(frame) == ReadStatus::kFrame) {
    sizes.push_back(frame.bgr.size());
    depths.push_back(frame.bgr.depth());
  }
  EXPECT_THAT(sizes, ElementsAre(cv::Size(1, 1), cv::Size(7, 13), cv::Size(33, 5), cv::Size(5, 3)));
  EXPECT_THAT(depths, ElementsAre(CV_8U, CV_8U, CV_16U, CV_16U));
}

TEST_F(ImagesSource, PassesOverBadFilesAmongGoodOnesWithAWarningEach) {
  write_text("0_text.png", "this is no picture");
  write_picture("1.png", 1);
  write_text("2_empty.png", "");
  write_picture("3_cut.png", 3, {64, 64});
  keep_first_bytes("3_cut.png", 0.6);
  write_picture("4_cut.jpg", 4, {64, 64});
  keep_first_bytes("4_cut.jpg", 0.9);
  write_picture("5.jpg", 5);
  write_picture("6_cut.bmp", 6, {64, 64});
  keep_first_bytes("6_cut.bmp", 0.5);
  fs::create_symlink(path("nowhere"), path("7_dangling.png"));
  write_picture("8.png", 8);
  write_text("9_text.png", "after a good one");
  auto source = opened(folder_, ", fps: 1000");
  EXPECT_THAT(frames_of(*source), ElementsAre(Seen{1, milliseconds(1)}, Seen{5, milliseconds(5)},
                                              Seen{8, milliseconds(8)}))
      << "what is passed over keeps its moment";
  EXPECT_THAT(reporter_.messages(), SizeIs(7));
  EXPECT_THAT(reporter_.messages(),
              AllOf(Contains(HasSubstr("0_text.png' is passed over")),
                    Contains(AllOf(HasSubstr("2_empty.png"), HasSubstr("it is empty"))),
                    Contains(AllOf(HasSubstr("4_cut.jpg"), HasSubstr("ends too early")))));
}

TEST_F(ImagesSource, SaysOnceWhatInAFolderIsNotNamedLikeAPicture) {
  write_picture("a.png", 1);
  write_text("notes.txt", "x");
  write_text("a.json", "{}");
  write_text(".hidden", "x");
  fs::create_directories(folder_ / "inner.png");
  EXPECT_THAT(values(frames_of(*opened(folder_))), ElementsAre(1));
  EXPECT_THAT(reporter_.messages(),
              ElementsAre(AllOf(HasSubstr("passed over 2 files"), HasSubstr("a.json"))));
}

TEST_F(ImagesSource, PassesOverPicturesOfAbsurdSize) {
  // A PNG header that promises 2·10⁹ × 2·10⁹ pixels.
  std::string bomb("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x77\x35\x94\x00\x77\x35\x94\x00\x08\x02\0\0\0",
                   29);
  write_text("1_bomb.png", bomb + std::string("\0\0\0\0\0\0\0\0IDAT", 12));
  // And a header of 19 bytes that asks for 3.6 GB.
  write_text("2_bomb.pgm", "P5 60000 60000 255\n");
  write_picture("3.png", 3);
  EXPECT_THAT(values(frames_of(*opened(folder_))), ElementsAre(3));
  EXPECT_THAT(reporter_.messages(), SizeIs(2));
}

TEST_F(ImagesSource, FailsToOpenWhenNoPictureCanBeRead) {
  write_text("a.png", "x");
  write_text("b.png", "y");
  EXPECT_THAT([&] { opened(folder_); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("no picture of"), HasSubstr("2 tried"), HasSubstr("b.png"))));
}

TEST_F(ImagesSource, FailsToOpenWhatIsNotThere) {
  const auto message = [&](const std::string& name) {
    try {
      opened(path(name));
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  fs::create_directories(folder_ / "empty");
  write_text("empty/readme.txt", "x");
  EXPECT_THAT(message("nowhere"), HasSubstr("there is no file or folder"));
  EXPECT_THAT(message("*.gif"), HasSubstr("no file matches the pattern"));
  EXPECT_THAT(message("empty"), HasSubstr("holds no picture (1 other files)"));
}

TEST_F(ImagesSource, EndsWithAnErrorWhenEveryPictureVanishesWhileLooping) {
  write_picture("a.png", 1);
  write_picture("b.png", 2);
  auto source = opened(folder_, ", loop: true");
  frames_of(*source, 3);
  fs::remove(path("a.png"));
  fs::remove(path("b.png"));
  EXPECT_THROW(frames_of(*source, 1), std::runtime_error);
}

/// A JPEG that is 8 × 4 as stored and asks to be turned by a quarter.
void write_turned_jpeg(const std::string& file) {
  std::vector<uchar> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", cv::Mat(4, 8, CV_8UC3, cv::Scalar(9, 9, 9)), jpeg));
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0"
      "MM\0*\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
      "\0\0\0\0",
      36);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(jpeg.data()), 2);
  stream << exif;
  stream.write(reinterpret_cast<const char*>(jpeg.data()) + 2,
               static_cast<std::streamsize>(jpeg.size()) - 2);
}

TEST_F(ImagesSource, TurnsPicturesAsExifSaysUnlessToldNotTo) {
  write_turned_jpeg(path("turned.jpg"));
  Frame frame;
  ASSERT_EQ(opened(folder_)->read(frame), ReadStatus::kFrame);
  EXPECT_EQ(frame.bgr.size(), cv::Size(4, 8));
  ASSERT_EQ(opened(folder_, ", exif_rotation: false")->read(frame), ReadStatus::kFrame);
  EXPECT_EQ(frame.bgr.size(), cv::Size(8, 4));
}

}  // namespace
