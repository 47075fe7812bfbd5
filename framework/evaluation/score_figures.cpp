#include "maggic/score_figures.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/wording.hpp"

namespace maggic {
namespace {

int digits_of(const Figure& figure) { return figure.unit.empty() ? 0 : figure.unit == "%" ? 2 : 3; }

std::string with_unit(const std::string& number, const Figure& figure) {
  return figure.unit.empty() ? number : number + ' ' + figure.unit;
}

std::optional<double> percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::optional<double> count(std::uint64_t count, std::uint64_t frames) {
  if (frames == 0) return std::nullopt;
  return static_cast<double>(count);
}

std::optional<double> rate(std::uint64_t count, std::uint64_t frames) {
  if (frames == 0) return std::nullopt;
  return static_cast<double>(count) / static_cast<double>(frames);
}

/// Collects figures whose names share a beginning.
class Sheet {
 public:
  void add(std::string name, std::optional<double> value, std::string unit, Better better,
           std::string meaning) {
    figures.push_back(
        {prefix + std::move(name), value, std::move(unit), better, std::move(meaning)});
  }

  void add_errors(const std::string& what, const std::string& unit, const ErrorDistribution& errors,
                  const std::string& meaning) {
    const auto value = [&](double of) {
      return errors.count() == 0 ? std::nullopt : std::optional(of);
    };
    add(what + "_rmse_" + unit, value(errors.rmse()), unit, Better::kLower,
        meaning + ", root of the mean square");
    add(what + "_p95_" + unit, value(errors.quantile(0.95)), unit, Better::kLower,
        meaning + ", not passed by 95 %");
    add(what + "_max_" + unit, value(errors.max()), unit, Better::kLower, meaning + ", largest");
  }

  void add_places(const ObjectTally& tally) {
    add_errors("position", "px", tally.position_px, "distance from the true place");
    add_errors("position", "mm", tally.position_mm, "distance from the true place");
  }

  void add_jitter(const ObjectTally& tally) {
    add("jitter_px", tally.jitter_px.deviation(), "px", Better::kLower,
        "deviation from the own mean while standing still");
    add("jitter_mm", tally.jitter_mm.deviation(), "mm", Better::kLower,
        "deviation from the own mean while standing still");
  }

  void add_found(const ObjectTally& tally) {
    add("seen", percent(tally.seen, tally.frames), "%", Better::kHigher,
        "true objects that were found");
    add("predicted", percent(tally.predicted, tally.frames), "%", Better::kLower,
        "true objects not found, but predicted where they are");
    add("missed", percent(tally.missed(), tally.frames), "%", Better::kLower,
        "true objects neither found nor predicted");
    add("within_tolerance", percent(tally.within_tolerance, tally.seen), "%", Better::kHigher,
        "objects found that are within the truth's tolerance");
  }

  void add_identities(const ObjectTally& tally) {
    add("identity", percent(tally.right_identity, tally.frames), "%", Better::kHigher,
        "true robots that were found with the right team and id (or player colours)");
    add("wrong_id", percent(tally.wrong_identity, tally.seen), "%", Better::kLower,
        "robots found with another team or id (or player colours)");
    add("unknown_id", percent(tally.unknown_identity, tally.seen), "%", Better::kLower,
        "robots found with the right team, but no id (or player colours)");
    add("swapped", percent(tally.exchanged, tally.seen), "%", Better::kLower,
        "robots found that bear each other's identity");
  }

  void add_robot(const ObjectTally& tally) {
    add_found(tally);
    add_identities(tally);
    add_places(tally);
    add_errors("heading", "deg", tally.heading_deg, "angle from the true heading");
    add_jitter(tally);
  }

  void add_ball(const ObjectTally& tally) {
    add_found(tally);
    add_places(tally);
    add_jitter(tally);
  }

  void add_times(std::string_view step, const DurationHistogram& times) {
    constexpr std::array<std::pair<const char*, double>, 3> kQuantiles{
        {{"p50", 0.50}, {"p95", 0.95}, {"p99", 0.99}}};
    for (const auto& [name, q] : kQuantiles) {
      const double ms = std::chrono::duration<double, std::milli>(times.quantile(q)).count();
      add(fmt::format("{}_{}_ms", step, name),
          times.count() == 0 ? std::nullopt : std::optional(ms), "ms", Better::kLower,
          fmt::format("time of {}, not passed by {:.0f} % of frames",
                      step == "frame_path" ? "segment, blobs and track" : step, q * 100.0));
    }
  }

  std::string prefix;
  std::vector<Figure> figures;
};

const std::vector<std::string>& known_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Figure& figure : score_figures(Scorecard(), StepStatistics(), std::nullopt)) {
      all.push_back(figure.name);
    }
    return all;
  }();
  return names;
}

const Figure* find(const std::vector<Figure>& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? nullptr : &*found;
}

Requirement parse_requirement(std::string_view item) {
  const std::size_t sign = item.find('=');
  const std::string_view name = item.substr(0, sign);
  if (std::ranges::find(known_names(), name) == known_names().end()) {
    throw std::invalid_argument("--require: " +
                                unknown_name_message("figure", name, known_names()));
  }
  double limit = 0.0;
  const std::string_view number =
      sign == std::string_view::npos ? std::string_view() : item.substr(sign + 1);
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), limit);
  if (error != std::errc() || stop != number.data() + number.size() || !std::isfinite(limit)) {
    throw std::invalid_argument(
        fmt::format("--require: {}: found {}, expected a number as in {}=1.5", name,
                    number.empty() ? "nothing" : quoted_excerpt(number), name));
  }
  return {std::string(name), limit};
}

}  // namespace

std::string number_text(const Figure& figure) {
  return figure.value ? fmt::format("{:.{}f}", *figure.value, digits_of(figure)) : "-";
}

std::string value_text(const Figure& figure) {
  return figure.value ? with_unit(number_text(figure), figure) : "-";
}

std::string difference_text(const Figure& figure, const Figure& other) {
  if (!figure.value || !other.value) return {};
  const double difference = *figure.value - *other.value;
  const int digits = digits_of(figure);
  if (std::abs(difference) < 0.5 * std::pow(10.0, -digits)) return "same";
  const bool better = (difference > 0.0) == (figure.better == Better::kHigher);
  return with_unit(fmt::format("{:+.{}f}", difference, digits), figure) +
         (better ? ", better" : ", worse");
}

std::vector<Figure> main_figures(const std::vector<Figure>& figures) {
  constexpr std::array<std::string_view, 20> kMain{"frames_right",
                                                   "seen",
                                                   "missed",
                                                   "within_tolerance",
                                                   "identity",
                                                   "wrong_id",
                                                   "position_p95_px",
                                                   "position_rmse_mm",
                                                   "position_p95_mm",
                                                   "heading_p95_deg",
                                                   "jitter_mm",
                                                   "swaps",
                                                   "false",
                                                   "ball_seen",
                                                   "ball_position_p95_mm",
                                                   "false_balls",
                                                   "corners_px",
                                                   "segment_p50_ms",
                                                   "frame_path_p50_ms",
                                                   "frame_path_p99_ms"};
  std::vector<Figure> main;
  for (const Figure& figure : figures) {
    if (std::ranges::find(kMain, figure.name) != kMain.end()) main.push_back(figure);
  }
  return main;
}

std::vector<Figure> robot_figures(const ObjectTally& tally) {
  Sheet sheet;
  sheet.add_robot(tally);
  return std::move(sheet.figures);
}

std::vector<Figure> ball_figures(const ObjectTally& tally) {
  Sheet sheet;
  sheet.add_ball(tally);
  return std::move(sheet.figures);
}

std::vector<Figure> score_figures(const Scorecard& card, const StepStatistics& times,
                                  std::optional<double> corners_px) {
  Sheet sheet;
  sheet.add("frames_right", percent(card.frames_right(), card.frames()), "%", Better::kHigher,
            "frames with everything within tolerance, rightly named, and nothing false");
  sheet.add_robot(card.robots());
  sheet.add("swaps", count(card.swaps(), card.frames()), "", Better::kLower,
            "how often two robots began to bear each other's identity");
  sheet.add("false", rate(card.false_robots(), card.frames()), "a frame", Better::kLower,
            "robots seen where there is none");

  sheet.prefix = "ball_";
  sheet.add_ball(card.ball());
  sheet.prefix.clear();
  sheet.add("false_balls", rate(card.false_balls(), card.frames()), "a frame", Better::kLower,
            "balls seen where there is none");

  sheet.add("corners_px", corners_px, "px", Better::kLower,
            "distance of the calibrated field corners from the true ones, largest");
  for (const Step step : {Step::kRead, Step::kSegment, Step::kBlobs, Step::kTrack}) {
    sheet.add_times(name_of(step), times.of(step));
  }
  sheet.add_times("frame_path", times.frame_path());
  return std::move(sheet.figures);
}

std::optional<double> corner_error_px(const Field& field, const Truth& truth) {
  if (truth.field_corners_px.size() != 4) return std::nullopt;
  // Corners are floor points; half_time turns the field frame, not the picture.
  const double turn = field.parameters().half_time ? -1.0 : 1.0;
  const double x = turn * field.parameters().length_mm / 2.0;
  const double y = turn * field.parameters().width_mm / 2.0;
  const std::array<cv::Point2d, 4> corners_mm{{{-x, y}, {x, y}, {x, -y}, {-x, -y}}};
  double largest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d off = field.to_image_px(corners_mm[i], 0.0) - truth.field_corners_px[i];
    largest = std::max(largest, std::hypot(off.x, off.y));
  }
  return largest;
}

std::vector<Requirement> parse_requirements(std::string_view text) {
  std::vector<Requirement> requirements;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    requirements.push_back(parse_requirement(text.substr(begin, end - begin)));
    const auto same = [&](const Requirement& r) { return r.name == requirements.back().name; };
    if (std::ranges::count_if(requirements, same) > 1) {
      throw std::invalid_argument(
          fmt::format("--require: {} occurs twice", requirements.back().name));
    }
    begin = end + 1;
  }
  return requirements;
}

std::vector<std::string> unmet(const std::vector<Requirement>& requirements,
                               const std::vector<Figure>& figures) {
  std::vector<std::string> sentences;
  for (const Requirement& required : requirements) {
    const Figure* figure = find(figures, required.name);
    if (figure == nullptr || !figure->value) {
      sentences.push_back(fmt::format("{}: there was nothing to measure, required {}",
                                      required.name, required.limit));
      continue;
    }
    const bool higher = figure->better == Better::kHigher;
    if (higher ? *figure->value >= required.limit : *figure->value <= required.limit) continue;
    const std::string unit = figure->unit.empty() ? "" : ' ' + figure->unit;
    sentences.push_back(fmt::format("{}: {:.6g}{}, required {} {}{}", required.name, *figure->value,
                                    unit, higher ? "at least" : "at most", required.limit, unit));
  }
  return sentences;
}

}  // namespace maggic
