#include <string_view>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "interchange/imported_blocks.hpp"

namespace maggic {
namespace {

const Place& place_of(const ForeignCalibration& calibration) {
  return std::visit([](const auto& file) -> const Place& { return file.place; }, calibration);
}

std::string_view kind_of(const ForeignCalibration& calibration) {
  constexpr std::array<std::string_view, 3> kKinds{"a Maggic session", "YUV boxes", "field limits"};
  return kKinds[calibration.index()];
}

/// The one calibration of kind T; null when there is none.
template <class T>
const T* the_only(std::span<const ForeignCalibration> calibrations,
                  std::vector<Mistake>& mistakes) {
  const ForeignCalibration* first = nullptr;
  for (const ForeignCalibration& calibration : calibrations) {
    if (!std::holds_alternative<T>(calibration)) continue;
    if (first == nullptr) {
      first = &calibration;
      continue;
    }
    mistakes.push_back(
        mistake_at({place_of(calibration).file, 0, 0},
                   fmt::format("found {} in this file and in {}, expected one file of a kind",
                               kind_of(calibration), quoted_excerpt(place_of(*first).file))));
  }
  return first == nullptr ? nullptr : &std::get<T>(*first);
}

class Import {
 public:
  void add(ImportedBlock block) {
    calibration_.yaml += block.yaml;
    calibration_.found.push_back(std::move(block.found));
    calibration_.notes.insert(calibration_.notes.end(), block.notes.begin(), block.notes.end());
  }
  void add_line(std::string_view line) { calibration_.yaml += line; }
  ImportedCalibration take() { return std::move(calibration_); }

 private:
  ImportedCalibration calibration_;
};

}  // namespace

ImportedCalibration import_calibrations(std::span<const ForeignCalibration> calibrations,
                                        std::optional<cv::Size> image_size_px) {
  std::vector<Mistake> mistakes;
  const auto* session = the_only<MaggicSession>(calibrations, mistakes);
  const auto* boxes = the_only<YuvBoxFile>(calibrations, mistakes);
  const auto* limits = the_only<FieldLimits>(calibrations, mistakes);
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));

  Import import;
  import.add_line(
      "# Venue numbers taken over from another program by `maggic import`; every comment says "
      "where\n"
      "# a number came from. Use it: maggic run PIPELINE --source MEDIA --calibration THIS_FILE\n");
  if (session != nullptr || boxes != nullptr) {
    import.add_line(
        "\n# Each plugin's numbers apply where the pipeline runs that plugin.\nsegmenter:\n");
    if (session != nullptr) import.add(import_pivots(*session));
    if (boxes != nullptr) import.add(import_boxes(*boxes));
  }
  if (limits != nullptr) {
    import.add_line("\n# What the camera sees of the field.\nfield:\n");
    import.add(import_corners(*limits, image_size_px));
  }
  return import.take();
}

}  // namespace maggic
