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
  std::string html = "<div class=\"wide\"><table>\n";
  for (const auto& [name, value] : report.facts) {
    html += fmt::format(
        "<tr><td>{}</td><td style=\"text-align:left;white-space:normal\">{}</td>"
        "</tr>\n",
        xml_escaped(name), xml_escaped(value));
  }
  return html + "</table></div>\n";
}

/// A row for each figure that any pipeline has a value for.
/// @param lists one list of figures a pipeline, all alike; empty lists have no column.
std::string figures_html(const ComparisonReport& report,
                         const std::vector<const std::vector<Figure>*>& lists, bool differences) {
  std::string html = "<div class=\"wide\"><table>\n<thead><tr><th>figure</th>";
  const std::vector<Figure>* model = nullptr;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (lists[i]->empty()) continue;
    if (model == nullptr) model = lists[i];
    html += fmt::format("<th>{}</th>", xml_escaped(report.pipelines[i].name));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; model != nullptr && row < model->size(); ++row) {
    const bool any = std::ranges::any_of(lists, [&](const std::vector<Figure>* figures) {
      return !figures->empty() && (*figures)[row].value;
    });
    if (!any) continue;
    html += fmt::format("<tr><td>{}<small>{}</small></td>", xml_escaped((*model)[row].name),
                        xml_escaped((*model)[row].meaning));
    for (const std::vector<Figure>* figures : lists) {
      if (figures->empty()) continue;
      const Figure& figure = (*figures)[row];
      html += fmt::format("<td>{}", xml_escaped(value_text(figure)));
      if (differences && figures != lists.front()) {
        html += fmt::format("<small>{}</small>",
                            xml_escaped(difference_text(figure, (*lists.front())[row])));
      }
      html += "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
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

template <class Member>
std::vector<const std::vector<Figure>*> lists_of(const ComparisonReport& report, Member member) {
  std::vector<const std::vector<Figure>*> lists;
  for (const ComparedPipeline& pipeline : report.pipelines) lists.push_back(&(pipeline.*member));
  return lists;
}

}  // namespace

std::string to_html(const ComparisonReport& report) {
  std::string body = facts_html(report);
  body += report.has_truth
              ? "<h2>Against the truth</h2>\n<p>In small print: the difference to the first.</p>\n"
              : "<h2>Times</h2>\n<p>In small print: the difference to the first.</p>\n";
  body += figures_html(report, lists_of(report, &ComparedPipeline::figures), true);
  body += "<h2>Agreement</h2>\n<p>What the first pipeline saw is taken as the truth.</p>\n";
  body += figures_html(report, lists_of(report, &ComparedPipeline::agreement), false);
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
  return html_page(report.title, body);
}

}  // namespace maggic
