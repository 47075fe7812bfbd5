#pragma once
/// The visitor that feeds a `describe` function from one node of a document.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maggic/document.hpp"
#include "maggic/parameter_reader.hpp"
#include "maggic/parameters.hpp"

namespace maggic {

/// Reads one node: a map of parameters, or, through the empty key, an element of a list itself.
class MapReader final : public Parameters {
 public:
  /// @param node what to read; null for a group that is not in the file, whose members keep their
  ///   defaults. Outlives the reader, as all other references do.
  /// @param path of the node below the section, for messages; empty for the section itself.
  /// @param place of mistakes that have no node of their own.
  MapReader(const Node* node, std::string path, Place place, const Palette& palette,
            std::vector<Mistake>& mistakes, Completeness completeness);

  /// Reports what `describe` never asked for. Called once, after `describe`.
  void finish();

  using Parameters::integer;
  using Parameters::number;
  void boolean(const Parameter& what, bool& value) override;
  void integer(const Parameter& what, int& value, Range<int> range) override;
  void number(const Parameter& what, double& value, Range<double> range) override;
  void text(const Parameter& what, std::string& value) override;
  void color(const Parameter& what, Label& value) override;
  void numbers(const Parameter& what, std::span<double> values, Range<double> range) override;
  void group(const Parameter& what, const std::function<void(Parameters&)>& members) override;
  void check(std::string_view key, bool holds, std::string_view message) override;
  const Palette& palette() const override { return palette_; }

 private:
  void choice_index(const Parameter& what, std::size_t& index,
                    std::span<const std::string_view> names) override;
  void list_elements(const Parameter& what, Elements& elements, Range<int> count) override;
  void color_elements(const Parameter& what, ColorElements& elements, Range<int> count) override;
  OptionalOutcome optional_value(const Parameter& what, bool has_default,
                                 const std::function<void()>& describe_value) override;

  /// The node `key` names, noted as asked for; null when the file does not hold it.
  const Node* look_up(std::string_view key);
  /// The same, noting a missing required key.
  const Node* look_up(const Parameter& what, std::string_view expected);
  /// The scalar of `what`; null after noting what else was found, or when it is not in the file.
  const Node* scalar(const Parameter& what, const std::string& expected, bool may_be_quoted);

  bool read_number(const Node& node, const std::string& path, double& value, Range<double> range);
  /// Reads `nodes` into `elements`, or, where their number does not fit, past them.
  void read_elements(const std::vector<const Node*>& nodes, const std::vector<std::string>& paths,
                     Elements& elements, bool fits);
  bool has_count(const Node& node, const std::string& path, std::size_t found, Range<int> count);
  std::string path_of(std::string_view key) const;
  void note(const Place& place, const std::string& path, std::string_view message);
  void note_expected(const Node& found, const std::string& path, std::string_view expected);

  const Node* node_;
  std::string path_;
  Place place_;
  const Palette& palette_;
  std::vector<Mistake>& mistakes_;
  std::size_t mistakes_before_;
  Completeness completeness_;
  std::vector<std::string> asked_;
  bool asked_for_itself_ = false;  ///< Read through the empty key: no map of parameters.
};

}  // namespace maggic
