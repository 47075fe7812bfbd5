#pragma once
/// Parameters: what can be configured about a stage, declared once.
///
/// A stage lists its parameters in one function, `describe(Parameters&)`. The same list reads them
/// from YAML, rejects unknown keys, prints `maggic describe` and feeds the documentation:
///
///     void describe(Parameters& p) override {
///       p.integer({"gray_threshold", "largest channel spread taken for gray", "8-bit steps"},
///                 gray_threshold_, {0, 255});
///     }
///
/// The member's initial value is the default. A reader that meets a mistake notes it with
/// file:line:col, leaves the member as it was and goes on, so one run reports every mistake;
/// `describe` itself never throws and must not act on values beyond `check`.

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <opencv2/core/types.hpp>

#include "maggic/palette.hpp"

namespace maggic {

enum class Presence { kOptional, kRequired };

/// What is said once about a parameter. An empty key means "this element itself" inside a list.
struct Parameter {
  std::string_view key;
  std::string_view meaning;
  std::string_view unit = {};
  Presence presence = Presence::kOptional;
};

/// Allowed values, both ends included.
template <class T>
struct Range {
  T min;
  T max;
};

/// One name a choice may take, with the value it stands for.
template <class E>
struct Choice {
  std::string_view name;
  E value;
};

/// Visitor over a stage's parameters. See the file comment.
class Parameters {
 public:
  virtual ~Parameters() = default;

  virtual void boolean(const Parameter& what, bool& value) = 0;
  virtual void integer(const Parameter& what, int& value, Range<int> range) = 0;
  /// Finite numbers only.
  virtual void number(const Parameter& what, double& value, Range<double> range) = 0;
  virtual void text(const Parameter& what, std::string& value) = 0;
  /// A colour of the palette by name; background is not accepted.
  virtual void color(const Parameter& what, Label& value) = 0;
  /// A sequence of exactly `values.size()` numbers, such as a point `[x, y]` or a span `[min,
  /// max]`.
  virtual void numbers(const Parameter& what, std::span<double> values, Range<double> range) = 0;

  /// A value that may be absent: an absent key leaves the default, `none` empties it.
  void number(const Parameter& what, std::optional<double>& value, Range<double> range);
  void integer(const Parameter& what, std::optional<int>& value, Range<int> range);

  /// `[x, y]`.
  void point(const Parameter& what, cv::Point2d& value, Range<double> range);
  void point(const Parameter& what, std::optional<cv::Point2d>& value, Range<double> range);

  /// One of a few names.
  template <class E>
  void choice(const Parameter& what, E& value, std::initializer_list<Choice<E>> choices) {
    std::vector<std::string_view> names;
    std::size_t index = 0;
    for (const Choice<E>& c : choices) {
      if (c.value == value) index = names.size();
      names.push_back(c.name);
    }
    choice_index(what, index, names);
    value = (choices.begin() + index)->value;
  }

  /// A map of further parameters under one key.
  virtual void group(const Parameter& what, const std::function<void(Parameters&)>& members) = 0;

  /// A list; `describe_element(Parameters&, T&)` describes one element. A list of scalars may also
  /// be written as one bare scalar. Reading replaces the default list as a whole.
  template <class T, class F>
  void list(const Parameter& what, std::vector<T>& values, Range<int> count, F describe_element) {
    VectorElements<T, F> elements(values, describe_element);
    list_elements(what, elements, count);
  }

  /// A map from palette colour to T, kept in the file's order (first match wins where order
  /// matters). Reading replaces the default map as a whole.
  template <class T, class F>
  void by_color(const Parameter& what, std::vector<std::pair<Label, T>>& values, Range<int> count,
                F describe_element) {
    ColorMapElements<T, F> elements(values, describe_element);
    color_elements(what, elements, count);
  }

  /// States a rule between parameters that a range cannot; the message is reported at `key`
  /// (empty: at the enclosing map). Write what was found and what was expected.
  virtual void check(std::string_view key, bool holds, std::string_view message) = 0;

  /// The palette colour names are resolved against.
  virtual const Palette& palette() const = 0;

 protected:
  /// Type-erased list the reader fills: reset to `count` default elements, then describe each.
  class Elements {
   public:
    virtual ~Elements() = default;
    virtual std::size_t size() const = 0;
    virtual void reset(std::size_t count) = 0;
    virtual void describe(std::size_t index, Parameters& parameters) = 0;
    /// Describes an element as `reset` would make it; the list stays as it is.
    virtual void describe_fresh(Parameters& parameters) = 0;
  };
  /// The same for a colour map: `reset`, then `label(i)` is set before `describe(i)`.
  class ColorElements : public Elements {
   public:
    virtual Label label(std::size_t index) const = 0;
    virtual void set_label(std::size_t index, Label label) = 0;
  };

  virtual void choice_index(const Parameter& what, std::size_t& index,
                            std::span<const std::string_view> names) = 0;
  virtual void list_elements(const Parameter& what, Elements& elements, Range<int> count) = 0;
  virtual void color_elements(const Parameter& what, ColorElements& elements, Range<int> count) = 0;

  /// What became of a value that may be absent.
  enum class OptionalOutcome {
    kUnchanged,  ///< Not in the file, or a mistake.
    kEmptied,    ///< `none` or `~` was written.
    kRead,
  };
  /// Visits a value that may be absent. `describe_value` visits it as the required value it may
  /// hold, and is called by printers whether or not there is a default.
  virtual OptionalOutcome optional_value(const Parameter& what, bool has_default,
                                         const std::function<void()>& describe_value) = 0;

 private:
  template <class T, class Visit>
  void visit_optional(const Parameter& what, std::optional<T>& value, Visit visit) {
    T read = value.value_or(T{});
    switch (optional_value(what, value.has_value(), [&] { visit(read); })) {
      case OptionalOutcome::kUnchanged: break;
      case OptionalOutcome::kEmptied: value.reset(); break;
      case OptionalOutcome::kRead: value = read; break;
    }
  }

  template <class T, class F>
  class VectorElements final : public Elements {
   public:
    VectorElements(std::vector<T>& values, F& describe) : values_(values), describe_(describe) {}
    std::size_t size() const override { return values_.size(); }
    void reset(std::size_t count) override { values_.assign(count, T{}); }
    void describe(std::size_t index, Parameters& p) override { describe_(p, values_[index]); }
    void describe_fresh(Parameters& p) override {
      T fresh{};
      describe_(p, fresh);
    }

   private:
    std::vector<T>& values_;
    F& describe_;
  };
  template <class T, class F>
  class ColorMapElements final : public ColorElements {
   public:
    ColorMapElements(std::vector<std::pair<Label, T>>& values, F& describe)
        : values_(values), describe_(describe) {}
    std::size_t size() const override { return values_.size(); }
    void reset(std::size_t count) override { values_.assign(count, {kBackground, T{}}); }
    void describe(std::size_t index, Parameters& p) override {
      describe_(p, values_[index].second);
    }
    void describe_fresh(Parameters& p) override {
      T fresh{};
      describe_(p, fresh);
    }
    Label label(std::size_t index) const override { return values_[index].first; }
    void set_label(std::size_t index, Label label) override { values_[index].first = label; }

   private:
    std::vector<std::pair<Label, T>>& values_;
    F& describe_;
  };
};

}  // namespace maggic
