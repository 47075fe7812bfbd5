#include "app/labelled_pictures.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <glob.h>

#include "maggic/frame_conversion.hpp"
#include "maggic/label_image.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/picture_name.hpp"
#include "maggic/source.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLabelsEnding = ".labels";

bool is_picture(const fs::path& file) {
  return has_picture_extension(file) && file.stem().extension() != kLabelsEnding;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

std::vector<fs::path> files_matching(const std::string& pattern) {
  std::vector<fs::path> files;
  glob_t found{};
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  return files;
}

/// What goes wrong is told by what comes, or does not.
class SilentReporter final : public Reporter {
 public:
  void warn(std::string_view) override {}
};

/// As it is in the file, of whatever type.
cv::Mat read_picture(const fs::path& file, const Palette& palette, PluginRegistry& registry) {
  SilentReporter reporter;
  const StagePtr<Source> source = registry.create<Source>("images");
  std::string quoted;  // a quote in YAML is doubled
  for (const char c : file.string()) quoted += c == '\'' ? "''" : std::string(1, c);
  configure_stage(*source, fmt::format("{{path: '{}', exif_rotation: false}}", quoted), palette,
                  reporter);
  Frame frame;
  try {
    source->open();
    while (source->read(frame) == ReadStatus::kRetry) {
    }
  } catch (const std::exception&) {
    frame.bgr.release();  // said below, in the words for a single picture
  }
  if (frame.bgr.empty()) {
    throw std::invalid_argument(
        fmt::format("cannot read '{}': it is no picture, or a damaged one", file.string()));
  }
  return frame.bgr;
}

}  // namespace

LabelledPictures find_labelled_pictures(const std::string& where) {
  std::error_code error;
  std::vector<fs::path> files =
      fs::is_directory(where, error) ? files_in(where) : files_matching(where);
  std::erase_if(files, [](const fs::path& file) { return !is_picture(file); });
  if (files.empty()) {
    throw std::invalid_argument(fmt::format(
        "no picture found in '{}': expected a folder or a pattern of files such as NAME.png, each "
        "with its labels beside it as NAME.labels.png",
        where));
  }
  std::ranges::sort(files);
  LabelledPictures found;
  for (const fs::path& file : files) {
    const fs::path labels = file.parent_path() / (file.stem().string() + ".labels.png");
    if (fs::is_regular_file(labels, error)) {
      found.pairs.push_back({file, labels});
    } else {
      ++found.unlabelled;
    }
  }
  if (found.pairs.empty()) {
    throw std::invalid_argument(fmt::format(
        "found {} picture{} in '{}', none with labels beside it: expected for {} a file "
        "{}.labels.png",
        files.size(), files.size() == 1 ? "" : "s", where, files.front().filename().string(),
        files.front().stem().string()));
  }
  return found;
}

void add_picture(const LabelledPicture& files, const Palette& palette, PluginRegistry& registry,
                 LabelledColors& colors) {
  cv::Mat picture = read_picture(files.picture, palette, registry);
  const cv::Mat label_picture = read_picture(files.labels, palette, registry);
  if (const auto unusable = convert_to_bgr8(picture)) {
    throw std::invalid_argument(fmt::format("{}: {}", files.picture.string(), *unusable));
  }
  try {
    colors.add(picture, labels_of(label_picture, palette));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", files.labels.string(), error.what()));
  }
}

}  // namespace maggic::app
