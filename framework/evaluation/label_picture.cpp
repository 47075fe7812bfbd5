#include "maggic/label_picture.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "maggic/parameter_reader.hpp"
#include "pipeline/image_path.hpp"
#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

constexpr std::string_view kThreshold = "gray_threshold";

/// How "no value" is written where a value may be absent.
bool is_off(std::string_view value) { return value.empty() || value == "none" || value == "~"; }

/// `parameters` with the threshold in it, whether or not it was there.
Node with_threshold(Node parameters, int gray_threshold) {
  Node value;
  value.kind = Node::Kind::kScalar;
  value.place = parameters.place;
  value.scalar = std::to_string(gray_threshold);
  parameters.set(kThreshold, std::move(value));
  return parameters;
}

}  // namespace

cv::Mat normalized_picture(const cv::Mat& bgr, Normalizer& normalizer) {
  ImagePath path;
  path.normalize(bgr, normalizer);
  return path.normalized();
}

cv::Mat label_picture(const cv::Mat& bgr, Normalizer& normalizer, Segmenter& segmenter,
                      std::size_t palette_size) {
  ImagePath path;
  path.normalize(bgr, normalizer);
  return path.segment(bgr, segmenter, palette_size).clone();
}

cv::Mat colored_labels(const cv::Mat& labels, const Palette& palette) {
  cv::Mat picture(labels.size(), CV_8UC3);
  for (int y = 0; y < labels.rows; ++y) {
    const Label* from = labels.ptr<Label>(y);
    auto* to = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < labels.cols; ++x) {
      const DisplayColor color = palette.display_color(from[x]);
      to[x] = cv::Vec3b(color.blue, color.green, color.red);
    }
  }
  return picture;
}

StagePtr<Segmenter> segmenter_with_threshold(const Node& section, int gray_threshold,
                                             PluginRegistry& registry,
                                             const StageContext& context) {
  if (section.entries.size() != 1) return {};
  const Node::Entry& plugin = section.entries.front();
  auto segmenter = registry.create<Segmenter>(plugin.key);
  const Describe describe = [&](Parameters& p) {
    guarded(StageKind::kSegmenter, plugin.key, "to describe its parameters",
            [&] { segmenter->describe(p); });
  };
  const std::vector<ParameterRow> rows = parameter_table(context.palette, describe);
  const auto row = std::ranges::find(rows, kThreshold, &ParameterRow::path);
  if (row == rows.end() || row->type.find("integer") == std::string::npos) return {};
  const Node* given = plugin.value.find(kThreshold);
  if (is_off(given == nullptr ? row->default_value : given->scalar)) return {};
  std::vector<Mistake> mistakes;
  read_parameters(with_threshold(plugin.value, gray_threshold), context.palette, describe,
                  mistakes);
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  guarded(StageKind::kSegmenter, plugin.key, "to prepare", [&] { segmenter->prepare(context); });
  return segmenter;
}

}  // namespace maggic
