#include "conformance.hpp"

namespace maggic::testing {

std::vector<std::string> check_conformance(StageKind kind, std::string_view name,
                                           std::string_view yaml) {
  Findings findings;
  const auto maker = [&]<class Kind>(std::type_identity<Kind>) {
    return Maker<Kind>([&] { return testing::make<Kind>(name, yaml); });
  };
  runs(findings, "making the stage", [&] {
    // A plugin that cannot be made at all is one sentence, not one a check; what is wrong with its
    // parameters is told even when they keep it from being made.
    registry().create(kind, name);
    check_describe([&] { return registry().create(kind, name); }, yaml, findings);
    make_stage(kind, name, yaml);
    switch (kind) {
      case StageKind::kSource: return check_source(maker(std::type_identity<Source>{}), findings);
      case StageKind::kNormalizer:
        return check_normalizer(maker(std::type_identity<Normalizer>{}), findings);
      case StageKind::kSegmenter:
        return check_segmenter(maker(std::type_identity<Segmenter>{}), findings);
      case StageKind::kTracker:
        return check_tracker(maker(std::type_identity<Tracker>{}), findings);
      case StageKind::kSink: return check_sink(maker(std::type_identity<Sink>{}), findings);
    }
  });
  return findings.take();
}

}  // namespace maggic::testing
