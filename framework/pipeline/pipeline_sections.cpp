#include "pipeline/pipeline_sections.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "config/wording.hpp"

namespace maggic {
namespace {

/// `name` becomes `{name: ~}`.
void write_out_plugin(Node& section) {
  if (section.kind != Node::Kind::kScalar) return;
  Node map;
  map.kind = Node::Kind::kMap;
  map.place = section.place;
  Node nothing;
  nothing.place = section.place;
  map.entries.push_back({section.scalar, section.place, std::move(nothing)});
  section = std::move(map);
}

/// The section's node, made where the file has none.
Node& section_of(Node& document, std::string_view key) {
  if (Node* section = document.find(key)) return *section;
  const Place whole_file{document.place.file, 0, 0};
  document.entries.push_back({std::string(key), whole_file, {}});
  document.entries.back().value.place = whole_file;
  return document.entries.back().value;
}

/// The one plugin a written-out section names; null when it does not name exactly one.
Node::Entry* plugin_of(Node* section) {
  const bool names_one =
      section != nullptr && section->kind == Node::Kind::kMap && section->entries.size() == 1;
  return names_one ? &section->entries.front() : nullptr;
}

std::optional<Node> load_map(const std::filesystem::path& file, std::string_view what,
                             std::vector<Mistake>& mistakes) {
  try {
    Node root = load_document(file);
    if (root.kind == Node::Kind::kMap) return root;
    mistakes.push_back(mistake_at(
        root.place, fmt::format("found {}, expected {} with the sections "
                                "{}",
                                description_of(root), what, fmt::join(known_sections(), ", "))));
  } catch (const ConfigError& e) {
    mistakes.insert(mistakes.end(), e.mistakes().begin(), e.mistakes().end());
  }
  return std::nullopt;
}

/// Lays a calibration over a pipeline; see pipeline_builder.hpp for what applies.
class CalibrationLayer {
 public:
  explicit CalibrationLayer(MergedRequest& merged) : merged_(merged) {}

  void lay(Node calibration) {
    for (Node::Entry& entry : calibration.entries) {
      if (entry.value.kind == Node::Kind::kNull) continue;  // All of it commented out, most likely.
      const auto stage = std::ranges::find(kStageSections, entry.key, &StageSection::key);
      if (stage != kStageSections.end()) {
        write_out_plugin(entry.value);
        lay_plugins(*stage, entry.value);
      } else if (entry.key == "sinks") {
        lay_sinks(entry.value);
      } else if (entry.key == "plugins") {
        lay_folders(entry.value);
      } else {
        Node section;
        section.kind = Node::Kind::kMap;
        section.entries.push_back(std::move(entry));
        merge_document(merged_.document, section);
      }
    }
  }

 private:
  void lay_plugins(const StageSection& stage, Node& blocks) {
    if (!is_map(blocks)) return;
    Node::Entry* running = plugin_of(merged_.document.find(stage.key));
    for (Node::Entry& block : blocks.entries) {
      if (running != nullptr && running->key == block.key) {
        merge_document(running->value, block.value);
      } else if (running != nullptr) {
        merged_.unused.push_back(
            {stage.kind, std::move(block), fmt::format("the pipeline runs '{}'", running->key)});
      }
    }
  }

  void lay_sinks(Node& calibrated) {
    if (calibrated.kind != Node::Kind::kSequence) {
      merged_.mistakes.push_back(mistake_at(
          calibrated.place,
          fmt::format("sinks: found {}, expected a list of sinks", description_of(calibrated))));
      return;
    }
    for (Node& item : calibrated.items) {
      write_out_plugin(item);
      if (!is_map(item)) continue;
      for (Node::Entry& block : item.entries) lay_sink(block);
    }
  }

  void lay_sink(Node::Entry& block) {
    bool is_used = false;
    for (Node& sink : section_of(merged_.document, "sinks").items) {
      Node::Entry* running = plugin_of(&sink);
      if (running == nullptr || running->key != block.key) continue;
      merge_document(running->value, block.value);
      is_used = true;
    }
    if (!is_used) {
      merged_.unused.push_back(
          {StageKind::kSink, std::move(block), "the pipeline has no such sink"});
    }
  }

  /// Added rather than put in place of the pipeline's, which it may need.
  void lay_folders(Node& folders) {
    Node& known = section_of(merged_.document, "plugins");
    if (known.kind == Node::Kind::kSequence && folders.kind == Node::Kind::kSequence) {
      std::ranges::move(folders.items, std::back_inserter(known.items));
    } else {
      known = std::move(folders);
    }
  }

  bool is_map(const Node& blocks) {
    if (blocks.kind == Node::Kind::kMap) return true;
    merged_.mistakes.push_back(mistake_at(
        blocks.place,
        fmt::format("found {}, expected plugins with their parameters", description_of(blocks))));
    return false;
  }

  MergedRequest& merged_;
};

/// Puts the requested source in place; its parameters follow once the calibration is laid.
void choose_source(Node& document, Node requested) {
  Node& section = section_of(document, "source");
  const Node::Entry* wanted = plugin_of(&requested);
  const Node::Entry* running = plugin_of(&section);
  if (wanted != nullptr && running != nullptr && wanted->key == running->key) return;
  if (wanted != nullptr) {
    Node nothing;
    nothing.place = wanted->value.place;
    requested.entries.front().value = std::move(nothing);
  }
  section = std::move(requested);
}

/// Lays the requested parameters over those of the pipeline and the calibration.
void set_source_parameters(Node& document, Node& requested) {
  const Node::Entry* wanted = plugin_of(&requested);
  Node::Entry* running = plugin_of(&section_of(document, "source"));
  if (wanted != nullptr && running != nullptr) merge_document(running->value, wanted->value);
}

void apply_assignment(MergedRequest& merged, std::string_view assignment) {
  // One that fails half way leaves nothing behind.
  Node trial = merged.document;
  try {
    set_in_document(trial, assignment);
    write_out_sections(trial);
    merged.document = std::move(trial);
  } catch (const ConfigError& e) {
    merged.mistakes.insert(merged.mistakes.end(), e.mistakes().begin(), e.mistakes().end());
  }
}

}  // namespace

const std::vector<std::string>& known_sections() {
  static const std::vector<std::string> sections{"palette",    "plugins",   "source",
                                                 "normalizer", "segmenter", "field",
                                                 "blobs",      "light",     "scan",
                                                 "tracker",    "sinks"};
  return sections;
}

void write_out_sections(Node& document) {
  if (document.kind != Node::Kind::kMap) return;
  for (const StageSection& stage : kStageSections) {
    if (Node* section = document.find(stage.key)) write_out_plugin(*section);
  }
  Node& normalizer = section_of(document, "normalizer");
  if (normalizer.kind == Node::Kind::kNull) {
    normalizer.kind = Node::Kind::kScalar;
    normalizer.scalar = "none";
    write_out_plugin(normalizer);
  }
  for (const char* key : {"sinks", "plugins"}) {
    Node& list = section_of(document, key);
    if (list.kind == Node::Kind::kNull) list.kind = Node::Kind::kSequence;
    if (list.kind == Node::Kind::kScalar) {
      Node one;
      one.kind = Node::Kind::kSequence;
      one.place = list.place;
      one.items.push_back(std::move(list));
      list = std::move(one);
    }
  }
  for (Node& sink : section_of(document, "sinks").items) write_out_plugin(sink);
}

MergedRequest merge_request(const PipelineRequest& request) {
  MergedRequest merged;
  std::vector<Mistake> unreadable;
  std::optional<Node> pipeline = load_map(request.pipeline, "a pipeline", unreadable);
  std::optional<Node> calibration;
  if (request.calibration) {
    calibration = load_map(*request.calibration, "a calibration", unreadable);
  }
  if (!unreadable.empty()) throw ConfigError(std::move(unreadable));

  merged.document = std::move(*pipeline);
  write_out_sections(merged.document);
  std::optional<Node> source = request.source;
  if (source) {
    write_out_plugin(*source);
    choose_source(merged.document, *source);
  }
  if (calibration) CalibrationLayer(merged).lay(std::move(*calibration));
  if (source) set_source_parameters(merged.document, *source);
  Node& sinks = section_of(merged.document, "sinks");
  for (Node sink : request.extra_sinks) {
    write_out_plugin(sink);
    sinks.items.push_back(std::move(sink));
  }
  for (const std::string& assignment : request.assignments) apply_assignment(merged, assignment);
  return merged;
}

Mistake note_of(const UnusedBlock& unused) {
  return mistake_at(unused.block.key_place,
                    fmt::format("calibration for {} '{}' is not used: {}", name_of(unused.kind),
                                unused.block.key, unused.reason));
}

}  // namespace maggic
