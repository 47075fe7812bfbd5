#pragma once
/// How right detections are, where the truth is known. Objects are matched by position first;
/// identity is compared afterwards.

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "maggic/detections.hpp"
#include "maggic/error_distribution.hpp"
#include "maggic/field.hpp"
#include "maggic/still_spread.hpp"
#include "maggic/truth.hpp"

namespace maggic {

/// What became of one true object over the judged frames, or of several together. Counts are
/// object-frames. seen + predicted + missed() = frames.
struct ObjectTally {
  std::uint64_t frames = 0;            ///< In which the truth has it.
  std::uint64_t seen = 0;              ///< … it was found, in state seen.
  std::uint64_t predicted = 0;         ///< … only a prediction stood there.
  std::uint64_t within_tolerance = 0;  ///< Of those seen.
  std::uint64_t right_identity = 0;    ///< Of those seen.
  std::uint64_t wrong_identity = 0;    ///< Of those seen: another team or id (or colours).
  std::uint64_t unknown_identity = 0;  ///< Of those seen: the right team, no id (or colours).
  std::uint64_t exchanged = 0;         ///< Of the wrong: it and another robot bear each other's.
  ErrorDistribution position_px;       ///< Of those seen, as all below.
  ErrorDistribution position_mm;
  ErrorDistribution heading_deg;  ///< 0 … 180.
  StillSpread jitter_px;
  StillSpread jitter_mm;

  std::uint64_t missed() const { return frames - seen - predicted; }
  void merge(const ObjectTally& other);
};

/// One true robot and what became of it.
struct RobotTally {
  TrueIdentity identity;
  ObjectTally tally;
};

/// Accumulates frames; forgets none. Constant memory but for the number of different robots.
///
/// Found and true objects match when they are no farther apart than a gate that is wider than the
/// tolerance: max(3 × tolerance, half a robot). So a biased position is one that is off, rather
/// than an object missed and a false one beside it. As many pairs as possible are matched, and of
/// those the nearest in total. What is only predicted is matched apart, with what is left, and is
/// never false.
class Scorecard {
 public:
  explicit Scorecard(Tolerance tolerance = {}) : tolerance_(tolerance) {}

  /// @param field of this frame: gives the unit a truth lacks, and pixels their size in mm.
  void add(const Detections& found, const TrueScene& truth, const Field& field);

  Tolerance tolerance() const { return tolerance_; }
  std::uint64_t frames() const { return frames_; }
  /// Frames with every object seen within the tolerance, every identity right, nothing false.
  std::uint64_t frames_right() const { return frames_right_; }

  const std::vector<RobotTally>& each_robot() const { return robots_; }  ///< By first appearance.
  ObjectTally robots() const;                                            ///< All together.
  const ObjectTally& ball() const { return ball_; }
  std::uint64_t false_robots() const { return false_robots_; }  ///< Seen where there is none.
  std::uint64_t false_balls() const { return false_balls_; }
  /// How often two robots began to bear each other's identity.
  std::uint64_t swaps() const { return swaps_; }

 private:
  struct Pair;
  bool judge_robots(const Detections& found, const TrueScene& truth, const Field& field);
  bool judge_ball(const Detections& found, const TrueScene& truth, const Field& field);
  std::size_t index_of(const TrueIdentity& identity);
  void judge_identities(const std::vector<Pair>& seen);

  Tolerance tolerance_;
  std::uint64_t frames_ = 0;
  std::uint64_t frames_right_ = 0;
  std::vector<RobotTally> robots_;
  ObjectTally ball_;
  std::uint64_t false_robots_ = 0;
  std::uint64_t false_balls_ = 0;
  std::uint64_t swaps_ = 0;
  std::set<std::pair<std::size_t, std::size_t>> exchanged_;  // pairs of robots_, as last seen
};

}  // namespace maggic
