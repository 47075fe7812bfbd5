/// `maggic sweep`: how many pixels are labelled right, against the gray threshold.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/console_reporter.hpp"
#include "app/labelled_pictures.hpp"
#include "app/pipeline_options.hpp"
#include "app/text_table.hpp"
#include "maggic/atomic_file.hpp"
#include "maggic/config_error.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/pipeline_builder.hpp"
#include "maggic/sweep_report.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kThreshold = "gray_threshold";
const cv::Size kPlotSize{640, 420};
const cv::Size kPanelSize{400, 270};

struct SweptNormalizer {
  std::string name;
  StagePtr<Normalizer> stage;
  const ColorNormalizer* by_color = nullptr;  ///< The stage; null when it needs the picture.
};

/// Makes single stages with the parameters a pipeline gives them.
class StageMaker {
 public:
  StageMaker(const Node& document, const Palette& palette, PluginRegistry& registry,
             Reporter& reporter)
      : document_(document), palette_(palette), registry_(registry), reporter_(reporter) {}

  /// The pipeline's parameters when it runs this very normalizer, its defaults otherwise.
  SweptNormalizer normalizer(const std::string& name) const {
    SweptNormalizer swept{name, registry_.create<Normalizer>(name), nullptr};
    const Node* section = document_.find("normalizer");
    const Node* parameters = section != nullptr ? section->find(name) : nullptr;
    configure(*swept.stage, parameters != nullptr ? *parameters : Node());
    swept.by_color = dynamic_cast<const ColorNormalizer*>(swept.stage.get());
    return swept;
  }

  StagePtr<Segmenter> segmenter(const std::string& name, int threshold) const {
    Node document = document_;
    set_in_document(document, fmt::format("segmenter.{}.{}={}", name, kThreshold, threshold));
    StagePtr<Segmenter> stage = registry_.create<Segmenter>(name);
    configure(*stage, *document.find("segmenter")->find(name));
    return stage;
  }

 private:
  /// An exception of the plugin's own type must not outlive the plugin, so it becomes one of ours.
  void configure(Stage& stage, const Node& parameters) const {
    std::vector<Mistake> mistakes;
    std::string reason;
    try {
      read_parameters(
          parameters, palette_, [&](Parameters& p) { stage.describe(p); }, mistakes);
      if (mistakes.empty()) return stage.prepare({palette_, reporter_});
    } catch (const std::exception& error) {
      reason = error.what();
    } catch (...) {
      reason = "an exception that is not a std::exception";
    }
    if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
    throw std::invalid_argument(fmt::format("a stage cannot be prepared: {}", reason));
  }

  const Node& document_;
  const Palette& palette_;
  PluginRegistry& registry_;
  Reporter& reporter_;
};

void check_segmenter(const NamedStage<Segmenter>& segmenter, const Palette& palette) {
  const auto rows = parameter_table(palette, [&](Parameters& p) { segmenter.stage->describe(p); });
  if (std::ranges::find(rows, kThreshold, &ParameterRow::path) == rows.end()) {
    throw std::invalid_argument(
        fmt::format("segmenter '{}' has no parameter {}, which is what a sweep varies",
                    segmenter.name, kThreshold));
  }
  if (dynamic_cast<const ColorSegmenter*>(segmenter.stage.get()) == nullptr) {
    throw std::invalid_argument(
        fmt::format("segmenter '{}' needs whole pictures; expected one that judges single colours",
                    segmenter.name));
  }
}

/// Those asked for, or all there are that look at colours alone.
std::vector<SweptNormalizer> normalizers_for(const SweepOptions& options, const StageMaker& make,
                                             PluginRegistry& registry) {
  std::vector<SweptNormalizer> swept;
  std::vector<std::string> seen;
  for (const std::string& name : options.normalizers) {
    if (std::ranges::find(seen, name) != seen.end()) continue;
    seen.push_back(name);
    swept.push_back(make.normalizer(name));
    if (swept.back().by_color == nullptr) {
      throw std::invalid_argument(fmt::format(
          "normalizer '{}' needs whole pictures; expected one that judges single colours", name));
    }
  }
  if (!options.normalizers.empty()) return swept;
  for (const PluginInfo& plugin : registry.scan().plugins) {
    if (plugin.kind != StageKind::kNormalizer) continue;
    SweptNormalizer one = make.normalizer(plugin.name);
    if (one.by_color != nullptr) swept.push_back(std::move(one));
  }
  return swept;
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

void print_table(const std::vector<NamedSweep>& sweeps, const Palette& palette, double share) {
  using Align = TextTable::Align;
  TextTable table(
      {Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight, Align::kLeft});
  table.add({"NORMALIZER", fmt::format("ALL ≥ {:.4g} %", 100.0 * share), "WIDTH", "BEST", "THERE",
             "LEAST"});
  for (const NamedSweep& named : sweeps) {
    const auto usable = named.sweep.usable(share);
    const std::size_t best = named.sweep.best_threshold();
    const auto [least, label] = named.sweep.smallest_share(best);
    table.add({named.normalizer,
               usable ? fmt::format("{} … {}", usable->first, usable->last) : "nowhere",
               std::to_string(usable ? usable->width() : 0), std::to_string(best), percent(least),
               std::string(palette.name(label))});
  }
  fmt::print("{}", table.to_string(0, static_cast<std::size_t>(Console(stdout).width())));
}

void write_report(const std::vector<NamedSweep>& sweeps, const Palette& palette, double share,
                  const fs::path& folder) {
  PlotGrid grid;
  grid.title = "Pixels labelled right, against the gray threshold";
  for (const NamedSweep& named : sweeps) {
    write_file_atomically(folder / (named.normalizer + ".svg"),
                          to_svg(plot_of(named, palette, share, kPlotSize)));
    grid.plots.push_back(plot_of(named, palette, share, kPanelSize));
  }
  write_file_atomically(folder / "sweep.svg", to_svg(grid));
  write_file_atomically(folder / "sweep.csv", csv_of(sweeps, palette));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument(fmt::format("cannot make the folder '{}': {}", folder.string(),
                                            error ? error.message() : "a file has that name"));
  }
}

}  // namespace

ExitCode sweep_command(const SweepOptions& options, const CommandLine& line) {
  const PipelineRequest request = make_request(options.pipeline);
  PluginRegistry registry = make_registry(line);
  Console console(stderr);
  ConsoleReporter reporter(console);
  const PipelineParts parts = build_parts(request, registry, reporter);
  const Palette& palette = parts.palette;
  const NamedStage<Segmenter>& segmenter = parts.segmenter;
  check_segmenter(segmenter, palette);
  std::vector<Mistake> notes;
  const Node document = merged_document(request, notes);
  const StageMaker make(document, palette, registry, reporter);
  const std::vector<SweptNormalizer> normalizers = normalizers_for(options, make, registry);

  const LabelledPictures pictures = find_labelled_pictures(options.images);
  if (pictures.unlabelled > 0) {
    console.line(fmt::format("{} of {} pictures have no labels beside them and are left out",
                             pictures.unlabelled, pictures.unlabelled + pictures.pairs.size()),
                 Console::Tone::kWarning, "note: ");
  }
  LabelledColors colors(palette);
  for (const LabelledPicture& picture : pictures.pairs) {
    add_picture(picture, palette, registry, colors);
  }
  make_folder(options.output);

  std::vector<const ColorNormalizer*> by_color;
  by_color.reserve(normalizers.size());
  for (const SweptNormalizer& normalizer : normalizers) by_color.push_back(normalizer.by_color);
  StagePtr<Segmenter> current;
  const std::vector<LabelSweep> swept =
      sweep_gray_threshold(colors, by_color, [&](int threshold) -> const ColorSegmenter& {
        current = make.segmenter(segmenter.name, threshold);
        return dynamic_cast<const ColorSegmenter&>(*current);
      });
  std::vector<NamedSweep> sweeps;
  for (std::size_t i = 0; i < swept.size(); ++i) sweeps.push_back({normalizers[i].name, swept[i]});

  const double share = options.share_percent / 100.0;
  fmt::print("{} picture{}, {} distinct colours\n\n", pictures.pairs.size(),
             pictures.pairs.size() == 1 ? "" : "s", colors.size());
  print_table(sweeps, palette, share);
  try {
    write_report(sweeps, palette, share, options.output);
  } catch (const std::exception& error) {
    console.line(error.what(), Console::Tone::kError, "error: ");
    return kFailed;
  }
  fmt::print("\nplots and sweep.csv are in {}\n", options.output.string());
  return kFine;
}

}  // namespace maggic::app
