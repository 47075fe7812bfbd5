#include "tracking/place_conflicts.hpp"

#include <algorithm>
#include <numeric>

#include "core/fill_with_room.hpp"

namespace maggic::tracking {

PlaceConflicts::PlaceConflicts(std::span<const LayoutModel> layouts)
    : layout_count_(layouts.size()) {
  for (const LayoutModel& layout : layouts) {
    for (const LayoutModel& other : layouts) {
      const double separation_mm = min_separation_mm(layout, other);
      squared_separations_mm2_.push_back(separation_mm * separation_mm);
      max_separation_mm_ = std::max(max_separation_mm_, separation_mm);
    }
  }
}

std::span<const std::pair<int, int>> PlaceConflicts::find(const TagBlobs& blobs,
                                                          std::span<const Candidate> candidates,
                                                          std::span<const Contender> contenders) {
  pairs_.clear();
  list(candidates, contenders);
  find_shared_blobs(blobs, candidates);
  find_overlaps();
  return pairs_;
}

void PlaceConflicts::list(std::span<const Candidate> candidates,
                          std::span<const Contender> contenders) {
  footprints_.clear();
  int last = -1;
  for (const Contender& contender : contenders) {
    if (contender.place == last) continue;
    last = contender.place;
    const Candidate& candidate = candidates[static_cast<std::size_t>(contender.place)];
    footprints_.push_back({candidate.pose.position_mm.x, candidate.pose.position_mm.y,
                           candidate.layout, contender.place, contender.group});
  }
}

void PlaceConflicts::find_overlaps() {
  std::ranges::sort(footprints_, [](const Footprint& a, const Footprint& b) {
    return a.x_mm != b.x_mm ? a.x_mm < b.x_mm : a.candidate < b.candidate;
  });
  for (auto a = footprints_.begin(); a != footprints_.end(); ++a) {
    const double last_x_mm = a->x_mm + max_separation_mm_;
    for (auto b = a + 1; b != footprints_.end() && b->x_mm <= last_x_mm; ++b) {
      const double x = b->x_mm - a->x_mm;
      const double y = b->y_mm - a->y_mm;
      // The squares spare a root, which would be the dearest operation here.
      if (x * x + y * y < squared_separation_mm2(a->layout, b->layout) && a->group != b->group) {
        pairs_.emplace_back(a->candidate, b->candidate);
      }
    }
  }
}

void PlaceConflicts::find_shared_blobs(const TagBlobs& blobs,
                                       std::span<const Candidate> candidates) {
  const auto for_each_blob = [&](auto visit) {
    for (const Footprint& footprint : footprints_) {
      for (const int index : candidates[static_cast<std::size_t>(footprint.candidate)].blobs) {
        if (index >= 0) visit(footprint, blobs.all()[static_cast<std::size_t>(index)]);
      }
    }
  };
  // Counted one source further, so that filling moves every begin to its place.
  fill_with_room(use_begins_, static_cast<std::size_t>(blobs.source_count()) + 2, 0);
  for_each_blob([&](const Footprint&, const MetricBlob& blob) {
    ++use_begins_[static_cast<std::size_t>(blob.source) + 2];
  });
  std::partial_sum(use_begins_.begin(), use_begins_.end(), use_begins_.begin());
  fill_with_room(uses_, static_cast<std::size_t>(use_begins_.back()), {});
  for_each_blob([&](const Footprint& footprint, const MetricBlob& blob) {
    int& next = use_begins_[static_cast<std::size_t>(blob.source) + 1];
    uses_[static_cast<std::size_t>(next++)] = {footprint.candidate, footprint.group, blob.parts};
  });
  for (std::size_t source = 0; source + 2 < use_begins_.size(); ++source) {
    const auto end = uses_.begin() + use_begins_[source + 1];
    for (auto a = uses_.begin() + use_begins_[source]; a != end; ++a) {
      for (auto b = a + 1; b != end; ++b) {
        if (a->group != b->group && (a->parts & b->parts) != 0) {
          pairs_.emplace_back(a->candidate, b->candidate);
        }
      }
    }
  }
}

}  // namespace maggic::tracking
