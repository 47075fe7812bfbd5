#include "studio/session/color_settings.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "maggic/parameter_reader.hpp"
#include "studio/session/bad_request.hpp"
#include "studio/session/node_json.hpp"

namespace maggic::studio {
namespace {

constexpr std::array<std::string_view, 2> kStages{"normalizer", "segmenter"};
constexpr std::array<std::string_view, 5> kOfSegmenter{"gray_threshold", "hue_of", "pivots",
                                                       "exclude", "boxes"};

// The map under `key`, made where there is none.
Node& map_under(Node& node, std::string_view key) {
  Node* found = node.find(key);
  if (found != nullptr && found->kind == Node::Kind::kMap) return *found;
  Node map;
  map.kind = Node::Kind::kMap;
  return node.set(key, std::move(map));
}

// Makes `map` hold the entries of `wanted`, those it had in their places.
void replace_entries(Node& map, const Node& wanted) {
  std::erase_if(map.entries,
                [&](const Node::Entry& entry) { return wanted.find(entry.key) == nullptr; });
  for (const Node::Entry& entry : wanted.entries) map.set(entry.key, entry.value);
}

Node values_of(Stage& stage, const Palette& palette) {
  return parameter_values(palette, [&](Parameters& p) { stage.describe(p); });
}

std::string text_of(const nlohmann::json& value, std::string_view key) {
  if (!value.is_string()) {
    throw BadRequest(422, fmt::format("{}: found {}, expected a name", key, value.dump()));
  }
  return value.get<std::string>();
}

// The entries of `before` that `now` has no more, as removals.
void remove_missing(Node& now, const Node& before) {
  for (const Node::Entry& entry : before.entries) {
    if (now.find(entry.key) == nullptr) now.entries.push_back({entry.key, {}, {}});
  }
}

}  // namespace

ColorStages color_stages(const PipelineParts& parts) {
  return {parts.normalizer.name, values_of(*parts.normalizer.stage, parts.palette),
          parts.segmenter.name, values_of(*parts.segmenter.stage, parts.palette)};
}

nlohmann::json color_settings(const ColorStages& stages) {
  nlohmann::json settings{{"normalizer", stages.normalizer}, {"segmenter", stages.segmenter}};
  for (const std::string_view key : kOfSegmenter) {
    const Node* value = stages.segmenter_values.find(key);
    settings[std::string(key)] = value != nullptr ? to_json(*value) : nlohmann::json();
  }
  return settings;
}

std::string plugin_in(const Node& document, std::string_view section) {
  const Node* stage = document.find(section);
  return stage != nullptr && stage->entries.size() == 1 ? stage->entries.front().key : "";
}

void change_colors(Node& document, const nlohmann::json& change) {
  if (!change.is_object()) {
    throw BadRequest(422, fmt::format("found {}, expected an object", change.type_name()));
  }
  for (const std::string_view kind : kStages) {
    const auto wanted = change.find(kind);
    if (wanted == change.end()) continue;
    const std::string plugin = text_of(*wanted, kind);
    if (plugin == plugin_in(document, kind)) continue;
    map_under(document.set(kind, {}), plugin);
  }
  Node& numbers = map_under(map_under(document, "segmenter"), plugin_in(document, "segmenter"));
  for (const auto& [key, value] : change.items()) {
    if (std::ranges::find(kStages, key) != kStages.end() || key == "revision") continue;
    if (std::ranges::find(kOfSegmenter, key) == kOfSegmenter.end()) {
      throw BadRequest(
          422, fmt::format("found the setting '{}', expected a known one (known: {}, {})", key,
                           fmt::join(kStages, ", "), fmt::join(kOfSegmenter, ", ")));
    }
    Node wanted = to_node(value, "the page");
    Node* held = numbers.find(key);
    if (held != nullptr && held->kind == Node::Kind::kMap && wanted.kind == Node::Kind::kMap) {
      replace_entries(*held, wanted);
    } else if (wanted.kind == Node::Kind::kNull) {
      std::erase_if(numbers.entries, [&](const Node::Entry& entry) { return entry.key == key; });
    } else {
      numbers.set(key, std::move(wanted));
    }
  }
}

void write_colors(Node& calibration, const Node& pipeline, const ColorStages& stages) {
  const auto write = [&](std::string_view kind, const std::string& plugin, Node values) {
    const Node* section = pipeline.find(kind);
    const Node* before = section != nullptr ? section->find(plugin) : nullptr;
    for (Node::Entry& entry : values.entries) {
      const Node* held = before != nullptr ? before->find(entry.key) : nullptr;
      if (held != nullptr && held->kind == Node::Kind::kMap) remove_missing(entry.value, *held);
    }
    if (values.kind == Node::Kind::kMap) {
      map_under(calibration, kind).set(plugin, std::move(values));
    }
  };
  write("normalizer", stages.normalizer, stages.normalizer_values);
  write("segmenter", stages.segmenter, stages.segmenter_values);
}

}  // namespace maggic::studio
