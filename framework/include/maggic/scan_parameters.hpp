#pragma once
/// The `scan:` section of a pipeline: which pixels are looked at, and by how many threads.

#include "maggic/parameters.hpp"

namespace maggic {

struct ScanParameters {
  enum class Search {
    kFull,       ///< All of the field in every frame.
    kPredicted,  ///< Round what was seen last in every frame, the rest of the field in turns.
  };

  static constexpr double kMaxMarginMm = 10'000.0;

  int threads = 1;
  /// How far beyond the field's lines is looked, where its corners are known; else the whole
  /// picture is.
  double margin_mm = 200.0;
  Search search = Search::kFull;
  /// With `kPredicted`: every place is looked at at least once in so many frames.
  int unseen_frames = 8;

  void describe(Parameters& parameters);
};

}  // namespace maggic
