#include "maggic/scan_parameters.hpp"

namespace maggic {

void ScanParameters::describe(Parameters& p) {
  p.integer({"threads", "how many threads share the rows of a frame; results do not depend on it"},
            threads, {1, 64});
  p.number({"margin_mm",
            "how far beyond the field's lines is looked, once the field's corners are known", "mm"},
           margin_mm, {0.0, kMaxMarginMm});
  p.choice({"search",
            "full: all of the field in every frame; predicted: round what was seen last, and the "
            "rest of the field in turns"},
           search, {{"full", Search::kFull}, {"predicted", Search::kPredicted}});
  p.integer(
      {"unseen_frames",
       "with search: predicted, something new is looked at after at most so many frames", "frames"},
      unseen_frames, {1, 240});
}

}  // namespace maggic
