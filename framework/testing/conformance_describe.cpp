#include <set>

#include "conformance.hpp"
#include "declaration_check.hpp"
#include "maggic/document.hpp"
#include "maggic/parameter_reader.hpp"

namespace maggic::testing {
namespace {

Describe describe_of(Stage& stage) {
  return [&stage](Parameters& parameters) { stage.describe(parameters); };
}

/// The stage's values as a document, what is declared of them checked on the way.
Node declared(Stage& stage, DeclarationCheck::Values values, Findings& findings) {
  DeclarationCheck check(standard_palette(), values, findings);
  stage.describe(check);
  return check.document();
}

void check_table(Stage& stage, Findings& findings) {
  std::set<std::string> paths;
  for (const ParameterRow& row : parameter_table(standard_palette(), describe_of(stage))) {
    if (row.meaning.empty()) findings.add("parameter '{}' has no meaning", row.path);
    if (!paths.insert(row.path).second) findings.add("'{}' is listed twice", row.path);
  }
}

}  // namespace

void check_describe(const Maker<Stage>& construct, std::string_view yaml, Findings& findings) {
  runs(findings, "describe", [&] {
    const StagePtr<Stage> fresh = construct();
    check_table(*fresh, findings);
    declared(*fresh, DeclarationCheck::Values::kIgnoreRequired, findings);

    const StagePtr<Stage> configured = construct();
    std::vector<Mistake> mistakes;
    read_parameters(parse_document(yaml, "parameters"), standard_palette(),
                    describe_of(*configured), mistakes);
    for (const Mistake& mistake : mistakes) {
      findings.add("its parameters are refused: {}", mistake.to_string());
    }
    if (!mistakes.empty()) return;
    const Node values = declared(*configured, DeclarationCheck::Values::kCheck, findings);

    // What a stage says of itself must be accepted as its configuration, and change nothing.
    const std::string text = to_yaml(values);
    const StagePtr<Stage> again = construct();
    read_parameters(parse_document(text, "its own values"), standard_palette(), describe_of(*again),
                    mistakes);
    for (const Mistake& mistake : mistakes) {
      findings.add("its own values are refused: {}", mistake.to_string());
    }
    Findings repeated;
    if (mistakes.empty() &&
        to_yaml(declared(*again, DeclarationCheck::Values::kCheck, repeated)) != text) {
      findings.add("its own values, read again, become others");
    }
  });
}

}  // namespace maggic::testing
