#pragma once
/// From a plugin's name and parameters to a stage that is ready to work.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/pipeline.hpp"
#include "maggic/plugin_registry.hpp"

namespace maggic {

/// Makes the stages of one pipeline; notes every mistake and goes on.
class StageBuilder {
 public:
  /// @param reporter outlives the stages; the others outlive the builder.
  StageBuilder(const Palette& palette, PluginRegistry& registry, Reporter& reporter,
               std::vector<Mistake>& mistakes)
      : palette_(palette), registry_(registry), reporter_(reporter), mistakes_(mistakes) {}

  /// @param section a map from one plugin's name to its parameters; anything else is a mistake.
  /// @return a stage that is configured and prepared; without one after a mistake.
  template <class T>
  NamedStage<T> build(const Node& section) {
    NamedStage<T> named;
    const Node::Entry* plugin = plugin_in(section, kStageKindOf<T>);
    if (plugin == nullptr) return named;
    StagePtr<Stage> stage = build(kStageKindOf<T>, *plugin);
    StageDeleter deleter = stage.get_deleter();
    named.name = plugin->key;
    named.stage = StagePtr<T>(static_cast<T*>(stage.release()), std::move(deleter));
    return named;
  }

  /// Reads parameters, perhaps a part of them, that no stage of the pipeline will use.
  /// @return why they could not be read: the plugin did not load.
  std::optional<std::string> check(StageKind kind, const Node::Entry& plugin);

 private:
  const Node::Entry* plugin_in(const Node& section, StageKind kind);
  StagePtr<Stage> build(StageKind kind, const Node::Entry& plugin);
  bool read(Stage& stage, StageKind kind, const Node::Entry& plugin, Completeness completeness);
  void note(const Place& place, std::string message);

  const Palette& palette_;
  PluginRegistry& registry_;
  Reporter& reporter_;
  std::vector<Mistake>& mistakes_;
};

}  // namespace maggic
