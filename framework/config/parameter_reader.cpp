#include "maggic/parameter_reader.hpp"

#include <utility>

#include <fmt/format.h>

#include "config/map_reader.hpp"
#include "config/wording.hpp"

namespace maggic {

void read_parameters(const Node& node, const Palette& palette, const Describe& describe,
                     std::vector<Mistake>& mistakes, Completeness completeness) {
  if (node.kind == Node::Kind::kScalar || node.kind == Node::Kind::kSequence) {
    mistakes.push_back(mistake_at(
        node.place, fmt::format("found {}, expected a map of parameters", description_of(node))));
    return;
  }
  MapReader reader(&node, "", node.place, palette, mistakes, completeness);
  describe(reader);
  reader.finish();
}

void configure_stage(Stage& stage, std::string_view yaml, const Palette& palette,
                     Reporter& reporter) {
  const Node node = parse_document(yaml, "parameters");
  std::vector<Mistake> mistakes;
  read_parameters(
      node, palette, [&](Parameters& p) { stage.describe(p); }, mistakes);
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
  stage.prepare({palette, reporter});
}

}  // namespace maggic
