#pragma once
/// The visitor that writes down what a `describe` function declares.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/parameters.hpp"

namespace maggic {

/// Collects a row per parameter and, as a tree, the default values. Changes no value.
class TablePrinter final : public Parameters {
 public:
  /// @param path of the described map or element; empty for the section itself.
  TablePrinter(std::string path, const Palette& palette)
      : path_(std::move(path)), palette_(palette) {}

  std::vector<ParameterRow> take_rows() { return std::move(rows_); }
  /// A map of the defaults, or the value itself of an element described through the empty key.
  Node take_defaults() { return std::move(defaults_); }

  using Parameters::integer;
  using Parameters::number;
  void boolean(const Parameter& what, bool& value) override;
  void integer(const Parameter& what, int& value, Range<int> range) override;
  void number(const Parameter& what, double& value, Range<double> range) override;
  void text(const Parameter& what, std::string& value) override;
  void color(const Parameter& what, Label& value) override;
  void numbers(const Parameter& what, std::span<double> values, Range<double> range) override;
  void group(const Parameter& what, const std::function<void(Parameters&)>& members) override;
  void check(std::string_view /*key*/, bool /*holds*/, std::string_view /*message*/) override {}
  const Palette& palette() const override { return palette_; }

 private:
  void choice_index(const Parameter& what, std::size_t& index,
                    std::span<const std::string_view> names) override;
  void list_elements(const Parameter& what, Elements& elements, Range<int> count) override;
  void color_elements(const Parameter& what, ColorElements& elements, Range<int> count) override;
  OptionalOutcome optional_value(const Parameter& what, bool has_default,
                                 const std::function<void()>& describe_value) override;

  /// Adds the row of one value, and the value to the defaults.
  void add(const Parameter& what, std::string type, Node value, std::string range = {});
  /// Adds the rows of a list or colour map whose elements are at `element_path`.
  void add_collection(const Parameter& what, const std::string& element_path, Elements& elements,
                      Node values, Range<int> count, std::string_view noun);
  void set_default(std::string_view key, Node value);
  std::string path_of(std::string_view key) const;

  std::string path_;
  const Palette& palette_;
  std::vector<ParameterRow> rows_;
  Node defaults_;
};

}  // namespace maggic
