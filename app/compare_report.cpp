#include "app/compare_report.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using Align = TextTable::Align;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kWidth = 200;

constexpr std::array<std::string_view, 17> kAgainstTruth{"frames_right",
                                                         "seen",
                                                         "missed",
                                                         "identity",
                                                         "wrong_id",
                                                         "swaps",
                                                         "within_tolerance",
                                                         "false",
                                                         "position_rmse_mm",
                                                         "position_p95_mm",
                                                         "position_p95_px",
                                                         "heading_p95_deg",
                                                         "jitter_mm",
                                                         "ball_seen",
                                                         "ball_position_p95_mm",
                                                         "false_balls",
                                                         "corners_px"};
constexpr std::array<std::string_view, 5> kTimes{"segment_p50_ms", "blobs_p50_ms", "track_p50_ms",
                                                 "frame_path_p50_ms", "frame_path_p99_ms"};
constexpr std::array<std::string_view, 11> kAgreement{"frames_right",    "seen",
                                                      "identity",        "within_tolerance",
                                                      "false",           "position_rmse_mm",
                                                      "position_p95_mm", "position_max_mm",
                                                      "ball_seen",       "ball_position_p95_mm",
                                                      "false_balls"};

const Figure* find(const std::vector<Figure>& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? nullptr : &*found;
}

}  // namespace

std::string figures_text(const std::vector<ComparedPipeline>& pipelines, bool has_truth) {
  std::vector<Align> columns(2 * pipelines.size(), Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  std::vector<std::string> header{""};
  for (const ComparedPipeline& pipeline : pipelines) {
    header.push_back(pipeline.name);
    if (&pipeline != &pipelines.front()) header.emplace_back("difference");
  }
  table.add(header);
  const auto add = [&](std::span<const std::string_view> names) {
    for (const std::string_view name : names) {
      const Figure* first = find(pipelines.front().figures, name);
      std::vector<std::string> row{std::string(name)};
      bool any = false;
      for (const ComparedPipeline& pipeline : pipelines) {
        const Figure* figure = find(pipeline.figures, name);
        if (figure == nullptr) continue;
        any = any || figure->value;
        row.push_back(value_text(*figure));
        if (&pipeline != &pipelines.front()) row.push_back(difference_text(*figure, *first));
      }
      if (any) table.add(std::move(row));
    }
  };
  if (has_truth) add(kAgainstTruth);
  add(kTimes);
  return table.to_string(kIndent, kWidth);
}

std::string agreement_text(const std::vector<ComparedPipeline>& pipelines) {
  std::vector<Align> columns(pipelines.size(), Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  std::vector<std::string> header{""};
  for (std::size_t i = 1; i < pipelines.size(); ++i) header.push_back(pipelines[i].name);
  table.add(header);
  for (const std::string_view name : kAgreement) {
    std::vector<std::string> row{std::string(name)};
    for (std::size_t i = 1; i < pipelines.size(); ++i) {
      const Figure* figure = find(pipelines[i].agreement, name);
      row.push_back(figure == nullptr ? "-" : value_text(*figure));
    }
    table.add(std::move(row));
  }
  return table.to_string(kIndent, kWidth);
}

}  // namespace maggic::app
