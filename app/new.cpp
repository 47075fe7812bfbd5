/// `maggic new`: the folder of a plugin to start from.

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/new_plugin.hpp"
#include "maggic/stage.hpp"

namespace maggic::app {
namespace {

StageKind kind_named(std::string_view name) {
  for (const StageKind kind : {StageKind::kSource, StageKind::kNormalizer, StageKind::kSegmenter,
                               StageKind::kTracker, StageKind::kSink}) {
    if (name_of(kind) == name) return kind;
  }
  throw std::invalid_argument(fmt::format(
      "there is no kind '{}' (known: source, normalizer, segmenter, tracker, sink)", name));
}

}  // namespace

ExitCode new_command(const NewOptions& options, const CommandLine& /*line*/) {
  new_plugin(kind_named(options.kind), options.name, options.folder);
  return kFine;
}

}  // namespace maggic::app
