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
Node& map_under(Node& node, const std::string& key) {
  node.kind = Node::Kind::kMap;
  Node* found = node.find(key);
  if (found == nullptr) {
    node.entries.push_back({key, {}, {}});
    found = &node.entries.back().value;
  }
  if (found->kind != Node::Kind::kMap) {
    *found = {};
    found->kind = Node::Kind::kMap;
  }
  return *found;
}

void set(Node& map, const std::string& key, Node value) {
  if (Node* known = map.find(key)) {
    *known = std::move(value);
  } else {
    map.entries.push_back({key, {}, std::move(value)});
  }
}

// Makes `map` hold the entries of `wanted`, those it had in their places.
void replace_entries(Node& map, const Node& wanted) {
  std::erase_if(map.entries,
                [&](const Node::Entry& entry) { return wanted.find(entry.key) == nullptr; });
  for (const Node::Entry& entry : wanted.entries) set(map, entry.key, entry.value);
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

void choose_stage(Node& document, std::string_view kind, const std::string& plugin) {
  Node section;
  section.kind = Node::Kind::kMap;
  map_under(section, plugin);
  set(document, std::string(kind), std::move(section));
}

// The entries of `before` that `now` has no more, as removals.
void remove_missing(Node& now, const Node& before) {
  for (const Node::Entry& entry : before.entries) {
    if (now.find(entry.key) == nullptr) now.entries.push_back({entry.key, {}, {}});
  }
}

}  // namespace

nlohmann::json color_settings(const PipelineParts& parts) {
  nlohmann::json settings{{"normalizer", parts.normalizer.name},
                          {"segmenter", parts.segmenter.name}};
  const Node values = values_of(*parts.segmenter.stage, parts.palette);
  for (const std::string_view key : kOfSegmenter) {
    const Node* value = values.find(key);
    settings[std::string(key)] = value != nullptr ? to_json(*value) : nlohmann::json();
  }
  return settings;
}

void change_colors(Node& document, const nlohmann::json& change, const nlohmann::json& settings) {
  if (!change.is_object()) {
    throw BadRequest(422, fmt::format("found {}, expected an object", change.type_name()));
  }
  for (const std::string_view kind : kStages) {
    const auto wanted = change.find(kind);
    if (wanted == change.end()) continue;
    const std::string plugin = text_of(*wanted, kind);
    if (plugin != settings.at(std::string(kind))) choose_stage(document, kind, plugin);
  }
  const std::string segmenter = change.value("segmenter", settings.at("segmenter"));
  Node& numbers = map_under(map_under(document, "segmenter"), segmenter);
  const bool is_same = segmenter == settings.at("segmenter");
  for (const auto& [key, value] : change.items()) {
    if (std::ranges::find(kStages, key) != kStages.end() || key == "revision") continue;
    const bool is_known = std::ranges::find(kOfSegmenter, key) != kOfSegmenter.end() &&
                          !(is_same && settings.at(key).is_null() && !value.is_null());
    if (!is_known && !(is_same && key == "gray_threshold")) {
      throw BadRequest(422, fmt::format("found the setting '{}', expected one that {} has (known: "
                                        "{}, {})",
                                        key, segmenter, fmt::join(kStages, ", "),
                                        fmt::join(kOfSegmenter, ", ")));
    }
    const Node wanted = to_node(value, "the page");
    Node* held = numbers.find(key);
    if (held != nullptr && held->kind == Node::Kind::kMap && wanted.kind == Node::Kind::kMap) {
      replace_entries(*held, wanted);
    } else if (wanted.kind == Node::Kind::kNull) {
      std::erase_if(numbers.entries, [&](const Node::Entry& entry) { return entry.key == key; });
    } else {
      set(numbers, key, wanted);
    }
  }
}

void write_colors(Node& calibration, const Node& pipeline, const PipelineParts& parts) {
  const auto write = [&](const std::string& kind, const std::string& plugin, Stage& stage) {
    Node values = values_of(stage, parts.palette);
    const Node* section = pipeline.find(kind);
    const Node* before = section != nullptr ? section->find(plugin) : nullptr;
    for (Node::Entry& entry : values.entries) {
      const Node* held = before != nullptr ? before->find(entry.key) : nullptr;
      if (held != nullptr && held->kind == Node::Kind::kMap) remove_missing(entry.value, *held);
    }
    if (values.kind == Node::Kind::kMap) {
      set(map_under(calibration, kind), plugin, std::move(values));
    }
  };
  write("normalizer", parts.normalizer.name, *parts.normalizer.stage);
  write("segmenter", parts.segmenter.name, *parts.segmenter.stage);
}

}  // namespace maggic::studio
