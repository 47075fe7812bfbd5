#pragma once
/// What every plugin is: a Stage with parameters and a short life cycle.
///
/// Life cycle, driven by the host, always in this order:
///   1. default construction: cheap, opens nothing (it also happens for `maggic describe`);
///   2. `describe` with a reader: parameters take their configured values;
///   3. `prepare`: derive tables from the parameters; throw to refuse them;
///   4. the work of its kind, any number of times;
///   5. destruction.
/// One thread at a time enters a stage, though not always the same thread. Two instances never
/// share mutable state. After the first frame a stage allocates nothing per frame.
///
/// Exceptions: a stage reports trouble by throwing anything derived from std::exception with a
/// sentence a student can act on. The host adds the stage's name and the frame number.

#include <string_view>

#include "maggic/palette.hpp"
#include "maggic/parameters.hpp"

namespace maggic {

/// The five kinds of plugin.
enum class StageKind { kSource, kNormalizer, kSegmenter, kTracker, kSink };

/// "source", "normalizer", "segmenter", "tracker", "sink".
std::string_view name_of(StageKind kind);

/// Where a stage tells of something that deserves a word but not a stop. Thread-safe. Messages
/// that repeat are counted rather than repeated, so a stage may warn once per frame.
class Reporter {
 public:
  virtual ~Reporter() = default;
  /// @param message one sentence: what was found, what was done about it.
  virtual void warn(std::string_view message) = 0;
};

/// What a stage is given before it works. References stay valid as long as the stage lives.
struct StageContext {
  const Palette& palette;
  Reporter& reporter;
};

class Stage {
 public:
  Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  virtual ~Stage() = default;

  /// Lists the parameters; see parameters.hpp. A stage without parameters leaves it.
  virtual void describe(Parameters& /*parameters*/) {}

  /// Called once, after `describe` and before any work.
  virtual void prepare(const StageContext& /*context*/) {}
};

}  // namespace maggic
