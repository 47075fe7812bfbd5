#include "app/compare_json.hpp"

#include <optional>

namespace maggic::app {
namespace {

OrderedJson text_or_null(const std::optional<std::filesystem::path>& path) {
  return path ? OrderedJson(path->string()) : OrderedJson();
}

OrderedJson differences_json(const std::vector<Figure>& figures,
                             const std::vector<Figure>& of_first) {
  OrderedJson json = OrderedJson::object();
  std::vector<Figure> differences = figures;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const bool both = figures[i].value && of_first[i].value;
    differences[i].value =
        both ? std::optional(*figures[i].value - *of_first[i].value) : std::nullopt;
  }
  return to_json(differences);
}

}  // namespace

OrderedJson comparison_json(const std::vector<Contestant>& contestants,
                            const std::vector<ComparedPipeline>& pipelines, const Outcome& outcome,
                            const std::optional<std::filesystem::path>& truth,
                            const std::optional<std::string>& source) {
  OrderedJson json = {{"schema", "maggic-compare-1"},
                      {"source", source ? OrderedJson(*source) : OrderedJson()},
                      {"truth", text_or_null(truth)},
                      {"tolerance", to_json(outcome.comparison.against_truth(0).tolerance())},
                      {"pipelines", OrderedJson::array()},
                      {"different_frames", OrderedJson::array()}};
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const ComparedPipeline& pipeline = pipelines[i];
    json["pipelines"].push_back(
        {{"name", pipeline.name},
         {"pipeline", contestants[i].request.pipeline.string()},
         {"calibration", text_or_null(contestants[i].request.calibration)},
         {"frames", frames_json(outcome.comparison.against_truth(i), outcome.summaries[i])},
         {"figures", to_json(pipeline.figures)},
         {"differences",
          i == 0 ? OrderedJson() : differences_json(pipeline.figures, pipelines.front().figures)},
         {"agreement", i == 0 ? OrderedJson() : to_json(pipeline.agreement)}});
  }
  for (const DifferentFrames::Kept& kept : outcome.different.kept()) {
    json["different_frames"].push_back({{"frame", kept.sequence},
                                        {"objects", kept.difference.objects},
                                        {"apart_mm", kept.difference.apart_mm}});
  }
  return json;
}

}  // namespace maggic::app
