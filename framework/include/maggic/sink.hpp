#pragma once
/// Sinks: where results go. They run on threads of their own, behind bounded queues, so a slow or
/// broken sink never delays a frame.

#include "maggic/field.hpp"
#include "maggic/frame_result.hpp"
#include "maggic/source.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// What a sink knows when a run starts. References are valid until `close` returns.
struct RunInfo {
  const Palette& palette;
  SourceInfo source;
};

class Sink : public Stage {
 public:
  /// Called once before the first `write`. @throws std::exception when the output cannot be
  /// opened: the run goes on without this sink and ends with a non-zero exit code.
  virtual void open(const RunInfo& info) = 0;

  /// Takes one frame's result; frames arrive in order. `field` maps this frame's pixels.
  /// @throws std::exception when it cannot be written: counted, reported, and the run goes on.
  virtual void write(const FrameResult& result, const Field& field) = 0;

  /// Completes the output. Called once after the last `write`, on every clean end of the run,
  /// Ctrl-C included. @throws std::exception when the output is not complete (disk full).
  virtual void close() {}
};

}  // namespace maggic
