/// Names of the enumerations that appear in files and messages.

#include "maggic/frame_result.hpp"
#include "maggic/stage.hpp"

namespace maggic {

std::string_view name_of(StageKind kind) {
  switch (kind) {
    case StageKind::kSource: return "source";
    case StageKind::kNormalizer: return "normalizer";
    case StageKind::kSegmenter: return "segmenter";
    case StageKind::kTracker: return "tracker";
    case StageKind::kSink: return "sink";
  }
  return "unknown";
}

std::string_view name_of(Step step) {
  switch (step) {
    case Step::kRead: return "read";
    case Step::kSegment: return "segment";
    case Step::kBlobs: return "blobs";
    case Step::kTrack: return "track";
    case Step::kCount: break;
  }
  return "unknown";
}

}  // namespace maggic
