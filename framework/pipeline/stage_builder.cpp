#include "pipeline/stage_builder.hpp"

#include <exception>
#include <memory>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "pipeline/stage_guard.hpp"

namespace maggic {
namespace {

/// Says which stage a warning comes from.
class StageReporter final : public Reporter {
 public:
  StageReporter(StageKind kind, std::string_view name, Reporter& reporter)
      : prefix_(fmt::format("{} '{}': ", name_of(kind), name)), reporter_(reporter) {}

  void warn(std::string_view message) override { reporter_.warn(prefix_ + std::string(message)); }

 private:
  std::string prefix_;
  Reporter& reporter_;
};

/// What a stage's context refers to.
struct StageHome {
  std::shared_ptr<const PluginLibrary> library;
  Palette palette;
  StageReporter reporter;
};

/// Ties the home to the stage's deleter, which lets go of it right after the stage is gone, however
/// the stage is moved about: the deleter's pointer to the library owns the home around it.
StageHome& give_home(StagePtr<Stage>& stage, const Palette& palette, StageReporter reporter) {
  std::shared_ptr<const PluginLibrary>& library = stage.get_deleter().library;
  const PluginLibrary* const itself = library.get();
  auto home =
      std::make_shared<StageHome>(StageHome{std::move(library), palette, std::move(reporter)});
  library = std::shared_ptr<const PluginLibrary>(home, itself);
  return *home;
}

}  // namespace

std::optional<std::string> StageBuilder::check(StageKind kind, const Node::Entry& plugin) {
  try {
    const StagePtr<Stage> stage = registry_.create(kind, plugin.key);
    read(*stage, kind, plugin, Completeness::kPart);
  } catch (const PluginError& e) {
    return e.what();
  }
  return std::nullopt;
}

const Node::Entry* StageBuilder::plugin_in(const Node& section, StageKind kind) {
  if (section.kind == Node::Kind::kMap && section.entries.size() == 1) {
    return &section.entries.front();
  }
  std::string found = description_of(section);
  if (section.kind == Node::Kind::kMap) {
    std::vector<std::string> names;
    for (const Node::Entry& entry : section.entries) names.push_back(entry.key);
    found = fmt::format("{} plugins ({})", names.size(), fmt::join(names, ", "));
    if (names.empty()) found = "no plugin";
  }
  note(section.place, fmt::format("{}: found {}, expected one {} plugin by name", name_of(kind),
                                  found, name_of(kind)));
  return nullptr;
}

StagePtr<Stage> StageBuilder::build(StageKind kind, const Node::Entry& plugin) {
  StagePtr<Stage> stage;
  try {
    stage = registry_.create(kind, plugin.key);
  } catch (const PluginError& e) {
    note(plugin.key_place, e.what());
    return stage;
  }
  if (!read(*stage, kind, plugin, Completeness::kWhole)) return {};
  StageHome& home = give_home(stage, palette_, StageReporter(kind, plugin.key, reporter_));
  try {
    guarded(kind, plugin.key, "to prepare", [&] { stage->prepare({home.palette, home.reporter}); });
  } catch (const StageError& e) {
    note(plugin.key_place, e.what());
    return {};
  }
  return stage;
}

bool StageBuilder::read(Stage& stage, StageKind kind, const Node::Entry& plugin,
                        Completeness completeness) {
  const std::size_t before = mistakes_.size();
  try {
    guarded(kind, plugin.key, "to describe its parameters", [&] {
      read_parameters(
          plugin.value, palette_, [&](Parameters& p) { stage.describe(p); }, mistakes_,
          completeness);
    });
  } catch (const StageError& e) {
    note(plugin.key_place, e.what());
  }
  return mistakes_.size() == before;
}

void StageBuilder::note(const Place& place, std::string message) {
  mistakes_.push_back(mistake_at(place, std::move(message)));
}

}  // namespace maggic
