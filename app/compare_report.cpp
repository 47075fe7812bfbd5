#include "app/compare_report.hpp"

#include "app/text_table.hpp"

namespace maggic::app {
namespace {

using Align = TextTable::Align;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kWidth = 200;

}  // namespace

std::string figures_text(const std::vector<ComparedPipeline>& pipelines) {
  std::vector<Align> columns(2 * pipelines.size(), Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  std::vector<std::string> header{""};
  std::vector<std::vector<Figure>> figures;
  for (const ComparedPipeline& pipeline : pipelines) {
    header.push_back(pipeline.name);
    if (!figures.empty()) header.emplace_back("difference");
    figures.push_back(main_figures(pipeline.figures));
  }
  table.add(header);
  for (std::size_t line = 0; line < figures.front().size(); ++line) {
    const Figure& first = figures.front()[line];
    std::vector<std::string> row{first.name, value_text(first)};
    bool has_value = first.value.has_value();
    for (std::size_t i = 1; i < figures.size(); ++i) {
      const Figure& figure = figures[i][line];
      row.push_back(value_text(figure));
      row.push_back(difference_text(figure, first));
      has_value = has_value || figure.value;
    }
    if (has_value) table.add(std::move(row));
  }
  return table.to_string(kIndent, kWidth);
}

std::string agreement_text(const std::vector<ComparedPipeline>& pipelines) {
  std::vector<Align> columns(pipelines.size(), Align::kRight);
  columns.front() = Align::kLeft;
  TextTable table(columns);
  std::vector<std::string> header{""};
  std::vector<std::vector<Figure>> figures;
  for (std::size_t i = 1; i < pipelines.size(); ++i) {
    header.push_back(pipelines[i].name);
    figures.push_back(main_figures(pipelines[i].agreement));
  }
  table.add(header);
  for (std::size_t line = 0; line < figures.front().size(); ++line) {
    std::vector<std::string> row{figures.front()[line].name};
    bool has_value = false;
    for (const std::vector<Figure>& of_pipeline : figures) {
      row.push_back(value_text(of_pipeline[line]));
      has_value = has_value || of_pipeline[line].value;
    }
    if (has_value) table.add(std::move(row));
  }
  return table.to_string(kIndent, kWidth);
}

}  // namespace maggic::app
