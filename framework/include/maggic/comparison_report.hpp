#pragma once
/// The report of a comparison: one HTML file that can be read offline, on paper white or dark, on a
/// phone.

#include <string>
#include <utility>
#include <vector>

#include "maggic/comparison.hpp"
#include "maggic/palette.hpp"
#include "maggic/score_figures.hpp"

namespace maggic {

/// What is told of one pipeline.
struct ComparedPipeline {
  std::string name;               ///< Short, unlike the others', such as "A maggic_3v3".
  std::vector<Figure> figures;    ///< Against the truth, and times; the same list for all.
  std::vector<Figure> agreement;  ///< With the first pipeline; empty for that one.
};

/// One picture with what is to be said about it.
struct ReportPicture {
  std::string caption;
  std::string png;
};

/// The labels one method gives one picture.
struct MethodLabels {
  std::string name;
  /// One for each gray threshold of the report, or a single one for a method without.
  std::vector<std::string> pngs;
};

struct ComparisonReport {
  std::string title;
  /// What was compared with what, as name and value: source, truth, frames …
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<ComparedPipeline> pipelines;  ///< At least one.
  bool has_truth = false;
  std::vector<FrameRow> rows;  ///< A point a pipeline in each.
  std::vector<ReportPicture> different_frames;
  ReportPicture segmented;  ///< The picture the labels are of; without bytes: left out.
  std::vector<int> thresholds;
  std::vector<MethodLabels> labels;
};

/// The colour of the n-th pipeline in every plot; told apart by people who see colours differently.
DisplayColor series_color(std::size_t pipeline);

std::string to_html(const ComparisonReport& report);

}  // namespace maggic
