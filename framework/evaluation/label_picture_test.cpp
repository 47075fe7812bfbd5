#include "maggic/label_picture.hpp"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

namespace maggic {
namespace {

class Unchanged final : public ColorNormalizer {
 public:
  void normalize(const ColorBatch& in, const MutableColorBatch& out) const override {
    std::ranges::copy(in.b, out.b.begin());
    std::ranges::copy(in.g, out.g.begin());
    std::ranges::copy(in.r, out.r.begin());
  }
};

/// Label 1 where there is more red than blue.
class Reddish final : public ColorSegmenter {
 public:
  void segment(const ColorBatch& original, const ColorBatch& /*normalized*/,
               std::span<Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = original.r[i] > original.b[i];
  }
};

TEST(LabelPicture, HoldsTheLabelOfEveryPixel) {
  cv::Mat bgr(2, 3, CV_8UC3, cv::Scalar(200, 0, 100));
  bgr.at<cv::Vec3b>(1, 2) = {10, 0, 20};
  Unchanged normalizer;
  Reddish segmenter;
  const cv::Mat labels = label_picture(bgr, normalizer, segmenter, 2);
  EXPECT_EQ(labels.size(), bgr.size());
  EXPECT_EQ(cv::countNonZero(labels), 1);
  EXPECT_EQ(labels.at<Label>(1, 2), 1);
}

TEST(LabelPicture, RefusesLabelsThePaletteDoesNotHave) {
  const cv::Mat bgr(1, 1, CV_8UC3, cv::Scalar(0, 0, 9));
  Unchanged normalizer;
  Reddish segmenter;
  EXPECT_THROW(label_picture(bgr, normalizer, segmenter, 1), std::runtime_error);
}

TEST(ColoredLabels, ShowEveryLabelInItsPaletteColour) {
  const Palette palette = Palette::standard();
  cv::Mat labels = cv::Mat::zeros(1, 2, CV_8UC1);
  labels.at<Label>(0, 1) = *palette.find("orange");
  const cv::Mat picture = colored_labels(labels, palette);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 1), cv::Vec3b(0, 128, 255));
}

}  // namespace
}  // namespace maggic
