/// Pictures written by us, read by somebody else's decoder.

#include "maggic/png.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <opencv2/core.hpp>

#include "maggic/source.hpp"
#include "maggic/testing.hpp"
#include "temporary_folder.hpp"

namespace maggic {
namespace {

cv::Mat read_back(const std::string& png) {
  const testing::Folder folder;
  const std::string file = folder.write("picture.png", png);
  const auto source = testing::make<Source>("images", "path: '" + file + "'");
  source->open();
  Frame frame;
  while (source->read(frame) == ReadStatus::kRetry) {
  }
  return frame.bgr;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

RC_GTEST_PROP(Png, HoldsThePictureAsItWas, ()) {
  const int width = *rc::gen::inRange(1, 40);
  const int height = *rc::gen::inRange(1, 40);
  cv::Mat wide(height, width + 3, CV_8UC3);
  cv::RNG random(*rc::gen::arbitrary<std::uint64_t>());
  random.fill(wide, cv::RNG::UNIFORM, 0, 256);
  // Smooth parts make the encoder choose other filters than noise does.
  wide.rowRange(0, height / 2).setTo(cv::Scalar(10, 200, 30));
  const cv::Mat picture = wide.colRange(0, width);  // rows are padded
  RC_ASSERT(equal(read_back(png_bytes(picture)), picture));
}

TEST(Png, RefusesWhatIsNoColourPicture) {
  EXPECT_THROW(png_bytes(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(png_bytes(cv::Mat(2, 2, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace maggic
