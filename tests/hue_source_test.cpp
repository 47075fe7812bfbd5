/// Which colour's hue tells tags apart best: that of the picture, or that of the normalised colour?
/// Measured on the annotated footage; docs/adr/0003-hue-of-the-original-colour.md has the table.

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "maggic/testing.hpp"
#include "maggic/truth_file.hpp"

namespace maggic {
namespace {

const std::filesystem::path kFootage =
    std::filesystem::path(MAGGIC_SOURCE_DIR) / ".." / "shared" / "footage";
constexpr int kPatchRadiusPx = 3;

cv::Mat first_picture(const std::string& plugin, const std::filesystem::path& media) {
  const auto source = testing::make<Source>(plugin, fmt::format("path: '{}'", media.string()));
  source->open();
  Frame frame;
  while (source->read(frame) == ReadStatus::kRetry) {
  }
  return frame.bgr;
}

cv::Mat normalized(const cv::Mat& bgr, const std::string& plugin) {
  const auto stage = testing::make<Normalizer>(plugin);
  const auto& normalizer = dynamic_cast<const ColorNormalizer&>(*stage);
  cv::Mat planes[3];
  cv::Mat result[3];
  for (int channel = 0; channel < 3; ++channel) {
    cv::extractChannel(bgr, planes[channel], channel);
    result[channel].create(bgr.size(), CV_8UC1);
  }
  const std::size_t size = bgr.total();
  normalizer.normalize({{planes[0].data, size}, {planes[1].data, size}, {planes[2].data, size}},
                       {{result[0].data, size}, {result[1].data, size}, {result[2].data, size}});
  cv::Mat joined;
  cv::merge(result, 3, joined);
  return joined;
}

/// Smallest stretch of hue, in 8-bit steps around the circle, between the middle 96 % of one
/// colour's tag pixels and the next colour's; negative where they overlap.
int smallest_gap(const cv::Mat& bgr, const TrueScene& truth) {
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV_FULL);
  std::map<Label, std::vector<int>> hues;
  const auto add = [&](Label color, cv::Point2d centre_px) {
    const cv::Point middle(cvRound(centre_px.x), cvRound(centre_px.y));
    for (int y = -kPatchRadiusPx; y <= kPatchRadiusPx; ++y) {
      for (int x = -kPatchRadiusPx; x <= kPatchRadiusPx; ++x) {
        const int hue = hsv.at<cv::Vec3b>(middle.y + y, middle.x + x)[0];
        std::vector<int>& of_color = hues[color];
        // Unrolled around the colour's first pixel, so that red does not fall apart at 0.
        const int first = of_color.empty() ? hue : of_color.front();
        of_color.push_back(first + (hue - first + 128 + 256) % 256 - 128);
      }
    }
  };
  for (const TrueRobot& robot : truth.robots) {
    for (const TrueTag& tag : robot.tags) add(tag.label, tag.centroid_px);
  }
  if (truth.ball) add(*Palette::standard().find("orange"), *truth.ball->centroid_px);

  std::vector<std::pair<int, int>> spans;
  for (auto& [color, of_color] : hues) {
    std::ranges::sort(of_color);
    const int low = of_color[of_color.size() * 2 / 100];
    const int high = of_color[of_color.size() * 98 / 100];
    const int turn = low < 0 ? 256 : low >= 256 ? -256 : 0;
    spans.emplace_back(low + turn, high + turn);
  }
  std::ranges::sort(spans);
  int gap = spans.front().first + 256 - spans.back().second;
  for (std::size_t i = 1; i < spans.size(); ++i) {
    gap = std::min(gap, spans[i].first - spans[i - 1].second);
  }
  return gap;
}

struct HueCase {
  std::string clip;
  std::string source;
};
void PrintTo(const HueCase& c, std::ostream* out) { *out << c.clip; }

class HueSource : public ::testing::TestWithParam<HueCase> {};

TEST_P(HueSource, TheOriginalColourTellsTagsApartAtLeastAsWell) {
  const HueCase& c = GetParam();
  if (!std::filesystem::exists(kFootage / (c.clip + ".json"))) {
    GTEST_SKIP() << "no footage at " << kFootage;
  }
  const Truth file = load_truth(kFootage / (c.clip + ".json"), Palette::standard());
  const TrueScene& truth = *file.every_frame;
  const cv::Mat picture = first_picture(c.source, kFootage / file.media);
  std::map<std::string, int> gap{{"original", smallest_gap(picture, truth)}};
  for (const char* normalizer : {"chromatic", "vector", "weighted"}) {
    gap[normalizer] = smallest_gap(normalized(picture, normalizer), truth);
  }
  for (const auto& [colour, steps] : gap) RecordProperty(colour, steps);
  // These two scale all channels alike, which leaves the hue as it is but for truncation.
  EXPECT_NEAR(gap["original"], gap["chromatic"], 1);
  EXPECT_NEAR(gap["original"], gap["vector"], 1);
  EXPECT_GT(gap["original"], gap["weighted"]);
}

INSTANTIATE_TEST_SUITE_P(
    Clips, HueSource,
    ::testing::Values(HueCase{"static", "video"}, HueCase{"tags_3v3_0", "video"},
                      HueCase{"tags_3v3_1", "video"}, HueCase{"all_tags", "video"},
                      HueCase{"rinobot_1", "images"}, HueCase{"vsssdk_model_3908ae", "images"}),
    [](const auto& test) { return test.param.clip; });

}  // namespace
}  // namespace maggic
