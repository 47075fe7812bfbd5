#pragma once
/// Truth from a JSON file: annotations made by hand, or frame by frame.
///
/// One scene that holds for every frame:
///
///     {"media": "clip.mp4", "size_px": [640, 480], "tolerance_px": 2.5,
///      "field_corners_px": [[39, -5], [601, -5], [601, 482], [39, 482]],
///      "ball": {"x": 59.6, "y": 322.6},
///      "robots": [{"team": "blue", "player_colors": ["cyan"], "x": 249.7, "y": 209.5,
///                  "heading_deg": 159.4, "tags": [{"color": "blue", "x": 244.4, "y": 207.6}]}]}
///
/// or `"frames": [{"frame": 0, "ball": null, "robots": []}, …]` in place of `ball` and `robots`,
/// with the same objects; frames that are not listed are not judged.
///
/// - `size_px` (required): width and height of the picture.
/// - `tolerance_px` or `tolerance_mm` (one is required): how far a right answer may be off.
/// - `media`: name of the recording. `field_corners_px`: top-left, top-right, bottom-right,
///   bottom-left.
/// - `ball` (required, may be null) and a robot's place: `x`,`y` or `x_px`,`y_px` in pixels,
///   `x_mm`,`y_mm` in the field frame, or both.
/// - a robot's `team` (required), and where known `id` (-1: not known), `player_colors`, `tags`,
///   and its heading: `heading_rad` of its front in the field frame, as the `jsonl` sink writes it,
///   or `heading_deg` in the picture from the mean of the player tags to the team tag,
///   counter-clockwise, y up; the front is the other way. Further keys are left alone.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/config_error.hpp"
#include "maggic/palette.hpp"
#include "maggic/truth.hpp"

namespace maggic {

/// What a truth file says.
struct Truth {
  std::string media;  ///< Empty where the file names none.
  cv::Size size_px;   ///< At least 1×1.
  Tolerance tolerance;
  std::vector<cv::Point2d> field_corners_px;  ///< None, or four.
  std::optional<TrueScene> every_frame;       ///< The one scene, or …
  std::map<std::uint64_t, TrueScene> frames;  ///< … one a frame, by its number.

  /// What is in frame `sequence`; null when the file does not say.
  const TrueScene* at(std::uint64_t sequence) const;
};

/// Limits that keep hostile files harmless.
inline constexpr std::size_t kMaxTruthBytes = 256u << 20;
inline constexpr std::size_t kMaxTrueRobots = 256;  ///< A frame.

/// @param file_name as shown in messages.
/// @param palette what colours are named by.
/// @throws ConfigError with every mistake: those of the JSON text by line and column, those of its
///   content by the path of the value, as in "/robots/2/team: found 'pink', expected …".
Truth parse_truth(std::string_view text, std::string_view file_name, const Palette& palette);

/// Reads and parses a file. @throws ConfigError also when it cannot be read.
Truth load_truth(const std::filesystem::path& file, const Palette& palette);

}  // namespace maggic
