#include "maggic/comparison_report.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "report/comparison_plots.hpp"
#include "report/html_page.hpp"
#include "report/svg_canvas.hpp"

namespace maggic {
namespace {

std::string facts_html(const ComparisonReport& report) {
  std::string html = "<table class=\"facts\">\n";
  for (const auto& [name, value] : report.facts) {
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", xml_escaped(name), xml_escaped(value));
  }
  return html + "</table>\n";
}

/// Figures of several pipelines, a column each.
struct FigureColumns {
  std::vector<std::string> names;
  std::vector<std::vector<Figure>> figures;
  bool with_differences = false;  ///< To the first column.
};

/// A row for each figure that any column has a value for.
std::string figures_html(const FigureColumns& columns) {
  if (columns.figures.empty()) return {};
  std::string html = "<div class=\"wide\"><table>\n<thead><tr><th>figure</th>";
  for (const std::string& name : columns.names) {
    html += fmt::format("<th>{}</th>", xml_escaped(name));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < columns.figures.front().size(); ++row) {
    const Figure& first = columns.figures.front()[row];
    std::string cells;
    bool has_value = false;
    for (const std::vector<Figure>& figures : columns.figures) {
      const Figure& figure = figures[row];
      has_value = has_value || figure.value;
      cells += fmt::format("<td>{}", xml_escaped(value_text(figure)));
      if (columns.with_differences && &figure != &first) {
        cells += fmt::format("<small>{}</small>", xml_escaped(difference_text(figure, first)));
      }
      cells += "</td>";
    }
    if (!has_value) continue;
    html += fmt::format("<tr><td>{}<small>{}</small></td>{}</tr>\n", xml_escaped(first.name),
                        xml_escaped(first.meaning), cells);
  }
  return html + "</tbody></table></div>\n";
}

FigureColumns figures_of(const ComparisonReport& report) {
  FigureColumns columns;
  columns.with_differences = true;
  for (const ComparedPipeline& pipeline : report.pipelines) {
    columns.names.push_back(pipeline.name);
    columns.figures.push_back(pipeline.figures);
  }
  return columns;
}

FigureColumns agreement_of(const ComparisonReport& report) {
  FigureColumns columns;
  for (const ComparedPipeline& pipeline : report.pipelines) {
    if (pipeline.agreement.empty()) continue;
    columns.names.push_back(pipeline.name);
    columns.figures.push_back(pipeline.agreement);
  }
  return columns;
}

FigureColumns main_of(FigureColumns columns) {
  for (std::vector<Figure>& figures : columns.figures) figures = main_figures(figures);
  return columns;
}

std::string pictures_html(const ComparisonReport& report) {
  std::string html;
  for (const ReportPicture& picture : report.different_frames) {
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        embedded_png(picture.png, picture.caption), xml_escaped(picture.caption));
  }
  return html;
}

std::string labels_html(const ComparisonReport& report) {
  const std::size_t columns = report.labels.size();
  const bool by_threshold = std::ranges::any_of(
      report.labels, [](const MethodLabels& method) { return method.pngs.size() > 1; });
  const std::size_t rows = by_threshold ? report.thresholds.size() : 1;
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"pictures\">\n<tr><td></td><td colspan=\"{}\">"
      "<figure style=\"max-width:40rem;margin:0 auto\">{}<figcaption>{}</figcaption></figure>"
      "</td></tr>\n<tr><th>{}</th>",
      columns, embedded_png(report.segmented.png, report.segmented.caption),
      xml_escaped(report.segmented.caption), by_threshold ? "gray threshold" : "");
  for (const MethodLabels& method : report.labels) {
    html += fmt::format("<th>{}</th>", xml_escaped(method.name));
  }
  html += "</tr>\n";
  for (std::size_t row = 0; row < rows; ++row) {
    html += "<tr><th>";
    if (by_threshold) html += std::to_string(report.thresholds[row]);
    html += "</th>";
    for (const MethodLabels& method : report.labels) {
      const bool spans = method.pngs.size() == 1 && rows > 1;
      if (row >= method.pngs.size()) continue;
      html += fmt::format("<td{}>{}</td>", spans ? fmt::format(" rowspan=\"{}\"", rows) : "",
                          embedded_png(method.pngs[row], fmt::format("labels of {}", method.name)));
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace

std::string to_html(const ComparisonReport& report) {
  const FigureColumns figures = figures_of(report);
  const FigureColumns agreement = agreement_of(report);
  std::string body = facts_html(report);
  body += report.has_truth ? "<h2>Against the truth</h2>\n" : "<h2>Times</h2>\n";
  body += "<p>In small print: the difference to the first.</p>\n" + figures_html(main_of(figures));
  body += "<h2>Agreement</h2>\n<p>What the first pipeline saw is taken as the truth.</p>\n" +
          figures_html(main_of(agreement));
  body += "<h2>Frame by frame</h2>\n";
  for (const std::string& svg : comparison_plots(report)) {
    body += fmt::format("<div class=\"paper\">{}</div>\n", svg);
  }
  if (!report.different_frames.empty()) {
    body += "<h2>Where they differ most</h2>\n" + pictures_html(report);
  }
  if (!report.segmented.png.empty()) {
    body += "<h2>Segmentation</h2>\n" + labels_html(report);
  }
  body += "<h2>Every figure</h2>\n<details><summary>all of them</summary>\n" +
          figures_html(figures) + "</details>\n";
  body += "<details><summary>all of the agreement</summary>\n" + figures_html(agreement) +
          "</details>\n";
  return html_page(report.title, body);
}

}  // namespace maggic
