#include "app/score_report.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using Align = TextTable::Align;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kWidth = 200;

struct Column {
  std::string_view title;
  std::string_view unit;
  std::string_view figure;
};
constexpr std::array kColumns{
    Column{"seen", "%", "seen"},
    Column{"predicted", "%", "predicted"},
    Column{"missed", "%", "missed"},
    Column{"identity", "%", "identity"},
    Column{"within", "%", "within_tolerance"},
    Column{"place p95", "px", "position_p95_px"},
    Column{"RMSE", "mm", "position_rmse_mm"},
    Column{"p95", "mm", "position_p95_mm"},
    Column{"max", "mm", "position_max_mm"},
    Column{"heading p95", "deg", "heading_p95_deg"},
    Column{"jitter", "mm", "jitter_mm"},
};

const Figure* find(const std::vector<Figure>& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? nullptr : &*found;
}

std::string cell(const std::vector<Figure>& figures, std::string_view name) {
  const Figure* figure = find(figures, name);
  return figure == nullptr ? "-" : number_text(*figure);
}

}  // namespace

std::string objects_text(const Scorecard& card, const Palette& palette) {
  std::vector<Align> columns(kColumns.size() + 1, Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  std::vector<std::string> titles{""};
  std::vector<std::string> units{""};
  for (const Column& column : kColumns) {
    titles.emplace_back(column.title);
    units.emplace_back(column.unit);
  }
  table.add(titles);
  table.add(units);
  const auto add = [&](std::string name, const std::vector<Figure>& figures) {
    std::vector<std::string> row{std::move(name)};
    for (const Column& column : kColumns) row.push_back(cell(figures, column.figure));
    table.add(std::move(row));
  };
  for (const RobotTally& robot : card.each_robot()) {
    add(name_of(robot.identity, palette), robot_figures(robot.tally));
  }
  if (!card.each_robot().empty()) add("all robots", robot_figures(card.robots()));
  if (card.ball().frames > 0) add("ball", ball_figures(card.ball()));
  return table.to_string(kIndent, kWidth);
}

std::string rest_text(const std::vector<Figure>& figures) {
  TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
  for (const std::string_view name : {"frames_right", "false", "false_balls", "wrong_id",
                                      "unknown_id", "swapped", "swaps", "corners_px"}) {
    const Figure* figure = find(figures, name);
    if (figure == nullptr || !figure->value) continue;
    table.add({figure->name, value_text(*figure), figure->meaning});
  }
  TextTable times({Align::kLeft, Align::kRight, Align::kRight, Align::kRight});
  times.add({"ms a frame", "p50", "p95", "p99"});
  for (const std::string step : {"read", "segment", "blobs", "track", "frame_path"}) {
    times.add({step == "frame_path" ? "frame path" : step, cell(figures, step + "_p50_ms"),
               cell(figures, step + "_p95_ms"), cell(figures, step + "_p99_ms")});
  }
  return table.to_string(kIndent, kWidth) + '\n' + times.to_string(kIndent, kWidth);
}

std::string tolerance_text(Tolerance tolerance) {
  return fmt::format("{:g} {}", tolerance.distance,
                     tolerance.unit == Tolerance::Unit::kPixels ? "px" : "mm");
}

}  // namespace maggic::app
