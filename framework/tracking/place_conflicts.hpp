#pragma once
/// Which candidates cannot both be robots: their blobs or the places they stand in overlap.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "assignment/assignment.hpp"
#include "tracking/candidate.hpp"
#include "tracking/candidate_generator.hpp"

namespace maggic::tracking {

class PlaceConflicts {
 public:
  explicit PlaceConflicts(std::span<const LayoutModel> layouts);

  /// Pairs of the candidates, by index, that are the places of `contenders`. Left out are pairs of
  /// one group, which exclude each other anyway; a pair may come twice.
  /// @param contenders those of a place follow each other.
  std::span<const std::pair<int, int>> find(const TagBlobs& blobs,
                                            std::span<const Candidate> candidates,
                                            std::span<const Contender> contenders);

 private:
  /// What of a candidate is looked at here, in little memory.
  struct Footprint {
    double x_mm = 0.0;
    double y_mm = 0.0;
    int layout = 0;
    int candidate = 0;
    int group = 0;
  };
  /// A blob, or a half of it, as a patch of a candidate.
  struct Use {
    int candidate = 0;
    int group = 0;
    unsigned parts = 0;
  };

  void list(std::span<const Candidate> candidates, std::span<const Contender> contenders);
  void find_overlaps();
  void find_shared_blobs(const TagBlobs& blobs, std::span<const Candidate> candidates);
  double squared_separation_mm2(int layout, int other) const {
    return squared_separations_mm2_[static_cast<std::size_t>(layout) * layout_count_ +
                                    static_cast<std::size_t>(other)];
  }

  std::size_t layout_count_;
  std::vector<double> squared_separations_mm2_;  ///< Of every layout from every other.
  double max_separation_mm_ = 0.0;
  std::vector<Footprint> footprints_;
  std::vector<int> use_begins_;  ///< Into uses_, by source.
  std::vector<Use> uses_;
  std::vector<std::pair<int, int>> pairs_;
};

}  // namespace maggic::tracking
