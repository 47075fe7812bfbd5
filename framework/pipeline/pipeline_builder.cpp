#include "maggic/pipeline_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "maggic/parameter_reader.hpp"
#include "pipeline/pipeline_sections.hpp"
#include "pipeline/stage_builder.hpp"

namespace maggic {
namespace {

/// Goes through the sections of one written-out document and notes every mistake on the way.
class Assembly {
 public:
  Assembly(const Node& document, PluginRegistry& registry, Reporter& reporter,
           std::vector<Mistake> mistakes)
      : document_(document),
        registry_(registry),
        reporter_(reporter),
        mistakes_(std::move(mistakes)) {}

  /// @throws ConfigError with every mistake.
  BuiltPipeline build(const std::vector<UnusedBlock>& unused) {
    BuiltPipeline built;
    PipelineParts parts = read_stages(unused, built);
    if (mistakes_.empty()) built.pipeline = make_pipeline(std::move(parts));
    if (!mistakes_.empty()) throw ConfigError(std::move(mistakes_));
    return built;
  }

  /// @throws ConfigError with every mistake.
  PipelineParts build_parts(const std::vector<UnusedBlock>& unused) {
    BuiltPipeline others;
    PipelineParts parts = read_stages(unused, others);
    if (!mistakes_.empty()) throw ConfigError(std::move(mistakes_));
    return parts;
  }

 private:
  /// What belongs to no frame path goes into `built`.
  PipelineParts read_stages(const std::vector<UnusedBlock>& unused, BuiltPipeline& built) {
    if (document_.kind != Node::Kind::kMap) {
      note(document_.place,
           fmt::format("found {}, expected a pipeline with the sections {}",
                       description_of(document_), fmt::join(known_sections(), ", ")));
      throw ConfigError(std::move(mistakes_));
    }
    refuse_unknown_sections();
    PipelineParts parts;
    parts.palette = read_palette();
    add_plugin_folders();
    StageBuilder stages(parts.palette, registry_, reporter_, mistakes_);

    built.source = build_stage<Source>(stages);
    parts.normalizer = build_stage<Normalizer>(stages);
    parts.segmenter = build_stage<Segmenter>(stages);
    read_section("field", parts.palette, [&](Parameters& p) { parts.field.describe(p); });
    read_section("blobs", parts.palette, [&](Parameters& p) { parts.blobs.describe(p); });
    read_section("light", parts.palette, [&](Parameters& p) { parts.light.describe(p); });
    read_section("scan", parts.palette, [&](Parameters& p) { parts.scan.describe(p); });
    check_field(parts.field);
    parts.tracker = build_stage<Tracker>(stages);
    built.sinks = build_sinks(stages);
    built.notes = check_unused(unused, stages);
    return parts;
  }

  void refuse_unknown_sections() {
    for (const Node::Entry& entry : document_.entries) {
      if (std::ranges::find(known_sections(), entry.key) == known_sections().end()) {
        note(entry.key_place, unknown_name_message("section", entry.key, known_sections()));
      }
    }
  }

  Palette read_palette() {
    Palette palette = Palette::standard();
    const Node* section = document_.find("palette");
    if (section == nullptr) return palette;
    constexpr std::size_t kMostColors = 255;
    if (section->entries.size() > kMostColors) {
      note(section->place, fmt::format("palette: found {} colours, expected at most {}",
                                       section->entries.size(), kMostColors));
      return palette;
    }
    read_section("palette", palette, [&](Parameters& p) {
      for (const Node::Entry& entry : section->entries) {
        std::array<double, 3> rgb{};
        p.numbers({entry.key, "red, green and blue"}, rgb, {0, 255});
        const bool whole = std::ranges::all_of(rgb, [](double v) { return v == std::floor(v); });
        p.check(entry.key, whole, "found a fraction, expected whole numbers from 0 to 255");
        // Set even after a mistake, so that its users are not said to use an unknown colour.
        set_color(palette, entry, rgb);
      }
    });
    return palette;
  }

  void set_color(Palette& palette, const Node::Entry& entry, const std::array<double, 3>& rgb) {
    const auto channel = [&](std::size_t i) { return static_cast<std::uint8_t>(rgb[i]); };
    try {
      palette.set(entry.key, {channel(0), channel(1), channel(2)});
    } catch (const std::invalid_argument& e) {
      note(entry.key_place, e.what());
    }
  }

  /// Folders are meant relative to the file that names them.
  void add_plugin_folders() {
    std::vector<std::string> folders;
    const Node* section = document_.find("plugins");
    if (section == nullptr) return;
    if (section->kind != Node::Kind::kSequence) {
      note(section->place,
           fmt::format("plugins: found {}, expected a list of folders", description_of(*section)));
      return;
    }
    for (const Node& item : section->items) {
      if (item.kind != Node::Kind::kScalar) {
        note(item.place, fmt::format("plugins: found {}, expected a folder", description_of(item)));
        continue;
      }
      const std::filesystem::path file = item.place.file;
      const std::filesystem::path folder = file.parent_path() / item.scalar;
      std::error_code error;
      if (std::filesystem::is_directory(folder, error)) {
        registry_.add_folder(folder);
      } else {
        note(item.place, fmt::format("plugins: found no folder '{}', expected one with plugins",
                                     folder.string()));
      }
    }
  }

  template <class T>
  NamedStage<T> build_stage(StageBuilder& stages) {
    constexpr StageKind kKind = kStageKindOf<T>;
    const Node* section = document_.find(name_of(kKind));
    if (section != nullptr && section->kind != Node::Kind::kNull) return stages.build<T>(*section);
    const Place whole_file{document_.place.file, 0, 0};
    note(section != nullptr ? section->place : whole_file,
         fmt::format("missing section '{}', expected a {} plugin by name", name_of(kKind),
                     name_of(kKind)));
    return {};
  }

  std::vector<NamedStage<Sink>> build_sinks(StageBuilder& stages) {
    std::vector<NamedStage<Sink>> sinks;
    const Node* section = document_.find("sinks");
    if (section == nullptr) return sinks;
    if (section->kind != Node::Kind::kSequence) {
      note(section->place,
           fmt::format("sinks: found {}, expected a list of sinks", description_of(*section)));
    }
    for (const Node& item : section->items) sinks.push_back(stages.build<Sink>(item));
    return sinks;
  }

  void read_section(std::string_view key, const Palette& palette, const Describe& describe) {
    static const Node kNothing;
    const Node* section = document_.find(key);
    read_parameters(section != nullptr ? *section : kNothing, palette, describe, mistakes_);
  }

  /// Corners that make no field are told before there is a frame.
  void check_field(const FieldParameters& field) {
    if (!mistakes_.empty()) return;
    const cv::Size any_size(640, 480);
    const Node* section = document_.find("field");
    try {
      Field(field, field.image_size_px.area() > 0 ? field.image_size_px : any_size);
    } catch (const std::exception& e) {
      note(section != nullptr ? section->place : document_.place,
           fmt::format("field: {}", e.what()));
    }
  }

  /// `key: ~` takes away what a pipeline has; where there is nothing to take from, it says nothing.
  static void drop_removals(Node& node) {
    std::erase_if(node.entries, [](const Node::Entry& entry) {
      return entry.value.kind == Node::Kind::kNull;
    });
    for (Node::Entry& entry : node.entries) drop_removals(entry.value);
  }

  std::vector<Mistake> check_unused(const std::vector<UnusedBlock>& unused, StageBuilder& stages) {
    std::vector<Mistake> notes;
    for (const UnusedBlock& block : unused) {
      Mistake told = note_of(block);
      Node::Entry part = block.block;
      drop_removals(part.value);
      if (const std::optional<std::string> reason = stages.check(block.kind, part)) {
        told.message += fmt::format("; not checked: {}", *reason);
      }
      notes.push_back(std::move(told));
    }
    return notes;
  }

  std::unique_ptr<Pipeline> make_pipeline(PipelineParts parts) {
    try {
      return std::make_unique<Pipeline>(std::move(parts), reporter_);
    } catch (const StageError& e) {
      note({document_.place.file, 0, 0}, e.what());
    }
    return nullptr;
  }

  void note(const Place& place, std::string message) {
    mistakes_.push_back(mistake_at(place, std::move(message)));
  }

  const Node& document_;
  PluginRegistry& registry_;
  Reporter& reporter_;
  std::vector<Mistake> mistakes_;
};

}  // namespace

Node merged_document(const PipelineRequest& request, std::vector<Mistake>& notes) {
  MergedRequest merged = merge_request(request);
  if (!merged.mistakes.empty()) throw ConfigError(std::move(merged.mistakes));
  for (const UnusedBlock& unused : merged.unused) notes.push_back(note_of(unused));
  return std::move(merged.document);
}

BuiltPipeline build_pipeline(const PipelineRequest& request, PluginRegistry& registry,
                             Reporter& reporter) {
  const MergedRequest merged = merge_request(request);
  return Assembly(merged.document, registry, reporter, merged.mistakes).build(merged.unused);
}

PipelineParts build_parts(const PipelineRequest& request, PluginRegistry& registry,
                          Reporter& reporter) {
  const MergedRequest merged = merge_request(request);
  return Assembly(merged.document, registry, reporter, merged.mistakes).build_parts(merged.unused);
}

BuiltPipeline build_pipeline(const Node& document, PluginRegistry& registry, Reporter& reporter) {
  Node written_out = document;
  write_out_sections(written_out);
  return Assembly(written_out, registry, reporter, {}).build({});
}

}  // namespace maggic
