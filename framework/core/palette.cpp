#include "maggic/palette.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace maggic {
namespace {

bool is_well_formed(std::string_view name) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_allowed = [&](char c) { return is_lower(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && is_lower(name.front()) && std::ranges::all_of(name, is_allowed);
}

}  // namespace

Palette::Palette() : entries_{{"background", {0, 0, 0}}} {}

Palette Palette::standard() {
  Palette palette;
  palette.set("orange", {255, 128, 0});
  palette.set("blue", {0, 64, 255});
  palette.set("yellow", {255, 230, 0});
  palette.set("red", {230, 20, 20});
  palette.set("green", {0, 190, 60});
  palette.set("magenta", {255, 0, 200});
  palette.set("cyan", {0, 220, 230});
  palette.set("purple", {140, 60, 200});
  palette.set("brown", {140, 85, 40});
  return palette;
}

Label Palette::set(std::string_view name, DisplayColor color) {
  if (!is_well_formed(name)) {
    throw std::invalid_argument(fmt::format(
        "colour name '{}': expected lower-case letters, digits and _, starting with a letter",
        name));
  }
  if (name == "background") {
    throw std::invalid_argument("colour name 'background' is taken by label 0");
  }
  if (const std::optional<Label> known = find(name)) {
    entries_[*known].color = color;
    return *known;
  }
  if (entries_.size() > 255) {
    throw std::invalid_argument(fmt::format("colour '{}' is one too many: expected at most 255",
                                            name));
  }
  entries_.push_back({std::string(name), color});
  return static_cast<Label>(entries_.size() - 1);
}

std::optional<Label> Palette::find(std::string_view name) const {
  const auto found = std::ranges::find(entries_, name, &Entry::name);
  if (found == entries_.end()) return std::nullopt;
  return static_cast<Label>(found - entries_.begin());
}

std::string_view Palette::name(Label label) const { return entries_.at(label).name; }

DisplayColor Palette::display_color(Label label) const { return entries_.at(label).color; }

std::string Palette::known_names() const {
  std::string names;
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    if (i > 1) names += ", ";
    names += entries_[i].name;
  }
  return names;
}

}  // namespace maggic
