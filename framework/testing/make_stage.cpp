#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace maggic::testing {
namespace {

/// Stages may warn as long as they live, and the tests that care bring a reporter of their own.
class SilentReporter final : public Reporter {
 public:
  void warn(std::string_view /*message*/) override {}
};

}  // namespace

void RecordingReporter::warn(std::string_view message) {
  const std::lock_guard lock(mutex_);
  messages_.emplace_back(message);
}

std::vector<std::string> RecordingReporter::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

const Palette& standard_palette() {
  static const Palette palette = Palette::standard();
  return palette;
}

PluginRegistry& registry() {
  static PluginRegistry registry;
  return registry;
}

StagePtr<Stage> make_stage(StageKind kind, std::string_view name, std::string_view yaml) {
  static SilentReporter reporter;
  StagePtr<Stage> stage = registry().create(kind, name);
  configure_stage(*stage, yaml, standard_palette(), reporter);
  return stage;
}

}  // namespace maggic::testing
