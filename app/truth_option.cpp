#include "app/truth_option.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace maggic::app {

TruthOption::TruthOption(std::optional<std::filesystem::path> file, const Palette& palette)
    : file_(std::move(file)) {
  if (file_) truth_ = load_truth(*file_, palette);
}

const TrueScene* TruthOption::scene_in(const Frame& frame) {
  if (!truth_) {
    if (!frame.has_truth) return nullptr;
    of_source_ = scene_of(frame.truth);
    return &of_source_;
  }
  const cv::Size size = frame.bgr.size();
  if (size != truth_->size_px) {
    throw ConfigError(
        {{file_->string(), 0, 0,
          fmt::format("/size_px: found {} x {}, but the source gives frames of {} x "
                      "{}: expected the truth of this recording",
                      truth_->size_px.width, truth_->size_px.height, size.width, size.height)}});
  }
  return truth_->at(frame.sequence);
}

std::string TruthOption::doubt_about(const std::optional<std::string>& source) const {
  if (!truth_ || truth_->media.empty() || !source) return {};
  std::error_code ignored;
  // A folder or a pattern may well hold the recording under another name.
  if (!std::filesystem::is_regular_file(*source, ignored)) return {};
  const std::string name = std::filesystem::path(*source).filename();
  if (name == truth_->media) return {};
  return fmt::format("{} is the truth of '{}', but the source reads '{}'", file_->string(),
                     truth_->media, name);
}

}  // namespace maggic::app
