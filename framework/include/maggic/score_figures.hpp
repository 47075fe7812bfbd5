#pragma once
/// The figures of a score as plain data, each with a name that is also its key in JSON and in
/// `--require`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/field.hpp"
#include "maggic/scorecard.hpp"
#include "maggic/step_statistics.hpp"
#include "maggic/truth_file.hpp"

namespace maggic {

/// Which way a figure gets better, and so what a requirement on it means.
enum class Better { kHigher, kLower };

struct Figure {
  std::string name;             ///< "seen", "position_rmse_mm", …
  std::optional<double> value;  ///< Nothing: there was nothing to measure.
  std::string unit;             ///< "%", "px", "mm", "deg", "ms", "a frame"; empty for a count.
  Better better = Better::kHigher;
  std::string meaning;  ///< One line.
};

/// "97.00", "0.412", a count without decimals; "-" where there was nothing to measure.
std::string number_text(const Figure& figure);

/// The same with its unit: "97.00 %", "0.412 mm".
std::string value_text(const Figure& figure);

/// "+1.500 mm, worse": a figure against the same of another run. "same" when they are equal as far
/// as they are written out; empty when either has no value.
std::string difference_text(const Figure& figure, const Figure& other);

/// What the whole run is judged by: robots, ball, calibrated corners, times; always the same names
/// in the same order.
/// @param corners_px distance of the calibrated corners from the truth's: see corner_error_px.
std::vector<Figure> score_figures(const Scorecard& card, const StepStatistics& times,
                                  std::optional<double> corners_px);

/// The same for one robot, or several together.
std::vector<Figure> robot_figures(const ObjectTally& tally);

/// The same for the ball, which has neither identity nor heading.
std::vector<Figure> ball_figures(const ObjectTally& tally);

/// The farthest any of the field's corners, as `field` puts them into the picture, lies from the
/// truth's, in pixels; nothing when the truth has none.
std::optional<double> corner_error_px(const Field& field, const Truth& truth);

/// `name=value`: the figure must be at least, or at most, the value, whichever is better.
struct Requirement {
  std::string name;
  double limit = 0.0;
};

/// @param text "seen=99,false=0".
/// @throws std::invalid_argument naming a figure that there is not with the known ones, a value
/// that
///   is no number, or a name that occurs twice.
std::vector<Requirement> parse_requirements(std::string_view text);

/// A sentence for every requirement that is not met; a figure without a value meets none.
std::vector<std::string> unmet(const std::vector<Requirement>& requirements,
                               const std::vector<Figure>& figures);

}  // namespace maggic
