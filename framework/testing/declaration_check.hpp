#pragma once
/// Reads off what a `describe` function declares, and whether its own values obey it.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "findings.hpp"
#include "maggic/document.hpp"
#include "maggic/parameters.hpp"

namespace maggic::testing {

/// Writes the current values into a document and notes ill-formed or repeated keys, missing
/// meanings, empty ranges and values outside of them. Changes nothing.
class DeclarationCheck final : public Parameters {
 public:
  enum class Values { kCheck, kIgnoreRequired };

  /// @param values a stage as constructed holds no meaningful values for its required parameters.
  DeclarationCheck(const Palette& palette, Values values, Findings& findings);

  /// The values as a file would give them; required ones are left out when they are ignored.
  Node document() const { return root_; }

  void boolean(const Parameter& what, bool& value) override;
  void integer(const Parameter& what, int& value, Range<int> range) override;
  void number(const Parameter& what, double& value, Range<double> range) override;
  void text(const Parameter& what, std::string& value) override;
  void color(const Parameter& what, Label& value) override;
  void numbers(const Parameter& what, std::span<double> values, Range<double> range) override;
  void group(const Parameter& what, const std::function<void(Parameters&)>& members) override;
  void check(std::string_view key, bool holds, std::string_view message) override;
  const Palette& palette() const override { return palette_; }

 protected:
  void choice_index(const Parameter& what, std::size_t& index,
                    std::span<const std::string_view> names) override;
  void list_elements(const Parameter& what, Elements& elements, Range<int> count) override;
  void color_elements(const Parameter& what, ColorElements& elements, Range<int> count) override;
  OptionalOutcome optional_value(const Parameter& what, bool has_default,
                                 const std::function<void()>& describe_value) override;

 private:
  /// The node to write a parameter's value to; null when its value does not count.
  Node* declare(const Parameter& what);
  void describe_into(Node& node, const std::function<void()>& describe);
  template <class T>
  void check_range(const Parameter& what, std::span<const T> values, Range<T> range);
  void check_count(const Parameter& what, std::size_t size, Range<int> count);

  const Palette& palette_;
  Values values_;
  Findings& findings_;
  Node root_;
  Node* current_ = &root_;         ///< The map or list element being described.
  std::vector<std::string> keys_;  ///< Declared so far in that map.
};

}  // namespace maggic::testing
