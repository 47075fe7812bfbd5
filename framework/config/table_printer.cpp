#include "config/table_printer.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "config/number_text.hpp"
#include "config/yaml_writer.hpp"

namespace maggic {
namespace {

Node scalar_node(std::string text, bool quoted = false) {
  Node node;
  node.kind = Node::Kind::kScalar;
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

/// A list that may have any length has no range worth a word.
std::string count_in_signs(Range<int> count) {
  if (count.min <= 0 && count.max == std::numeric_limits<int>::max()) return "";
  if (count.min == count.max) return fmt::format("{} entries", count.min);
  return range_in_signs(count) + " entries";
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

}  // namespace

void TablePrinter::boolean(const Parameter& what, bool& value) {
  add(what, "true or false", scalar_node(value ? "true" : "false"));
}

void TablePrinter::integer(const Parameter& what, int& value, Range<int> range) {
  add(what, "integer", scalar_node(fmt::format("{}", value)), range_in_signs(range));
}

void TablePrinter::number(const Parameter& what, double& value, Range<double> range) {
  add(what, "number", scalar_node(fmt::format("{}", value)), range_in_signs(range));
}

void TablePrinter::text(const Parameter& what, std::string& value) {
  add(what, "text", scalar_node(value));
}

void TablePrinter::color(const Parameter& what, Label& value) {
  const bool is_color = value != kBackground && value < palette_.size();
  add(what, "colour", is_color ? scalar_node(std::string(palette_.name(value))) : Node());
}

void TablePrinter::numbers(const Parameter& what, std::span<double> values, Range<double> range) {
  Node node;
  node.kind = Node::Kind::kSequence;
  for (const double value : values) node.items.push_back(scalar_node(fmt::format("{}", value)));
  add(what, fmt::format("[number ×{}]", values.size()), std::move(node), range_in_signs(range));
}

void TablePrinter::group(const Parameter& what, const std::function<void(Parameters&)>& members) {
  TablePrinter printer(path_of(what.key), palette_);
  members(printer);
  rows_.push_back({path_of(what.key), "map", what.presence == Presence::kRequired ? "required" : "",
                   "", std::string(what.unit), std::string(what.meaning)});
  for (ParameterRow& row : printer.rows_) rows_.push_back(std::move(row));
  set_default(what.key, printer.take_defaults());
}

void TablePrinter::choice_index(const Parameter& what, std::size_t& index,
                                std::span<const std::string_view> names) {
  add(what, fmt::format("one of {}", fmt::join(names, "|")),
      scalar_node(std::string(names[index])));
}

void TablePrinter::list_elements(const Parameter& what, Elements& elements, Range<int> count) {
  Node values;
  values.kind = Node::Kind::kSequence;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    TablePrinter printer("", palette_);
    elements.describe(i, printer);
    values.items.push_back(printer.take_defaults());
  }
  add_collection(what, path_of(what.key) + "[]", elements, std::move(values), count, "list");
}

void TablePrinter::color_elements(const Parameter& what, ColorElements& elements,
                                  Range<int> count) {
  Node values;
  values.kind = Node::Kind::kMap;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    TablePrinter printer("", palette_);
    elements.describe(i, printer);
    const Label label = elements.label(i);
    const std::string_view name = label < palette_.size() ? palette_.name(label) : "?";
    values.entries.push_back({std::string(name), {}, printer.take_defaults()});
  }
  const std::string path = path_of(what.key);
  add_collection(what, path.empty() ? "<color>" : path + ".<color>", elements, std::move(values),
                 count, "map by colour");
}

Parameters::OptionalOutcome TablePrinter::optional_value(
    const Parameter& what, bool has_default, const std::function<void()>& describe_value) {
  describe_value();
  if (!has_default && what.presence == Presence::kOptional) {
    rows_.back().default_value = "none";
    set_default(what.key, Node());
  }
  return OptionalOutcome::kUnchanged;
}

void TablePrinter::add(const Parameter& what, std::string type, Node value, std::string range) {
  std::string text = to_flow_yaml(value);
  if (what.presence == Presence::kRequired) text = "required";
  rows_.push_back({path_of(what.key), std::move(type), std::move(text), std::move(range),
                   std::string(what.unit), std::string(what.meaning)});
  set_default(what.key, std::move(value));
}

void TablePrinter::add_collection(const Parameter& what, const std::string& element_path,
                                  Elements& elements, Node values, Range<int> count,
                                  std::string_view noun) {
  TablePrinter printer(element_path, palette_);
  elements.describe_fresh(printer);
  std::vector<ParameterRow> members = printer.take_rows();
  // One row says it all where an element is a single value.
  if (members.size() == 1 && members.front().path == element_path) {
    const ParameterRow& element = members.front();
    const bool is_list = values.kind == Node::Kind::kSequence;
    const std::string type = is_list ? '[' + element.type + ']' : element.type;
    Parameter merged = what;
    if (merged.unit.empty()) merged.unit = element.unit;
    add(merged, type, std::move(values), joined(element.range, count_in_signs(count)));
    if (!is_list) rows_.back().path = element_path;
    return;
  }
  add(what, std::string(noun), std::move(values), count_in_signs(count));
  for (ParameterRow& row : members) rows_.push_back(std::move(row));
}

void TablePrinter::set_default(std::string_view key, Node value) {
  if (key.empty()) {
    defaults_ = std::move(value);
    return;
  }
  defaults_.set(key, std::move(value));
}

std::string TablePrinter::path_of(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::vector<ParameterRow> parameter_table(const Palette& palette, const Describe& describe) {
  TablePrinter printer("", palette);
  describe(printer);
  return printer.take_rows();
}

Node parameter_values(const Palette& palette, const Describe& describe) {
  TablePrinter printer("", palette);
  describe(printer);
  return printer.take_defaults();
}

}  // namespace maggic
