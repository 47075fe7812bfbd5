#pragma once
/// What a plugin's test needs: a configured stage in one line, and the conformance suite.
/// Link `maggic::testing`; uses no test framework itself.

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/palette.hpp"
#include "maggic/plugin_registry.hpp"
#include "maggic/stage.hpp"

namespace maggic::testing {

/// Keeps what it was told, for tests to look at.
class RecordingReporter final : public Reporter {
 public:
  void warn(std::string_view message) override;
  std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// The standard palette; lives as long as the program.
const Palette& standard_palette();

/// One registry over the default folders for the whole test program.
PluginRegistry& registry();

/// Creates plugin `name`, reads `yaml` (its parameters alone) and prepares it.
/// @throws PluginError, ConfigError, or what `prepare` throws.
StagePtr<Stage> make_stage(StageKind kind, std::string_view name, std::string_view yaml = "");

template <class T>
StagePtr<T> make(std::string_view name, std::string_view yaml = "") {
  StagePtr<Stage> stage = make_stage(kStageKindOf<T>, name, yaml);
  StageDeleter deleter = stage.get_deleter();
  return StagePtr<T>(static_cast<T*>(stage.release()), std::move(deleter));
}

/// Runs every promise of the kind's contract that can be tested against plugin `name`: odd sizes
/// and padded rows with guard bytes, determinism, batch equals single, two instances on two
/// threads, a sane `describe` (defaults within range, keys unique and well-formed, meanings given),
/// labels below the palette's size, what is said of boxes of colours against the colours in them,
/// ids unique a team, finite numbers.
/// @param yaml parameters the stage needs to work at all (a path, say).
/// @return one sentence per broken promise; empty when the plugin conforms.
std::vector<std::string> check_conformance(StageKind kind, std::string_view name,
                                           std::string_view yaml = "");

}  // namespace maggic::testing
