#include "maggic/picture_row.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace maggic {
namespace {

constexpr int kGapPx = 6;
constexpr int kTitleHeightPx = 28;
const cv::Scalar kGround(30, 30, 30);
const cv::Scalar kPaper(245, 245, 245);

}  // namespace

cv::Mat picture_row(std::span<const cv::Mat> pictures, std::span<const std::string> titles) {
  const auto model =
      std::ranges::find_if(pictures, [](const cv::Mat& picture) { return !picture.empty(); });
  if (model == pictures.end()) return {};
  std::vector<cv::Size> sizes;
  cv::Size whole(-kGapPx, 0);
  for (const cv::Mat& picture : pictures) {
    sizes.push_back(picture.empty() ? model->size() : picture.size());
    whole.width += sizes.back().width + kGapPx;
    whole.height = std::max(whole.height, sizes.back().height + kTitleHeightPx);
  }
  cv::Mat row(whole, CV_8UC3, kGround);
  int left = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    cv::Mat title = row(cv::Rect(left, 0, sizes[i].width, kTitleHeightPx));
    cv::putText(title, titles[i], {6, kTitleHeightPx - 9}, cv::FONT_HERSHEY_SIMPLEX, 0.6, kPaper, 1,
                cv::LINE_AA);
    if (!pictures[i].empty()) {
      pictures[i].copyTo(row(cv::Rect({left, kTitleHeightPx}, sizes[i])));
    }
    left += sizes[i].width + kGapPx;
  }
  return row;
}

}  // namespace maggic
