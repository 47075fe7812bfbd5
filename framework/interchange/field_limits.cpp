/// fieldLimits.json. JSON is YAML in flow style, so our own reader, which keeps places, reads it.

#include <cmath>

#include <fmt/format.h>

#include "config/number_text.hpp"
#include "config/wording.hpp"
#include "interchange/foreign_parsers.hpp"

namespace maggic {
namespace {

const std::vector<std::string>& point_names() {
  static const std::vector<std::string> names{"point1", "point2", "point3", "point4"};
  return names;
}

class Reader {
 public:
  FieldLimits read(const Node& root) {
    FieldLimits limits;
    limits.place = root.place;
    if (root.kind != Node::Kind::kMap) {
      note(root.place,
           fmt::format("found {}, expected an object with point1 … point4", description_of(root)));
    }
    for (const Node::Entry& entry : root.entries) {
      if (std::ranges::find(point_names(), entry.key) != point_names().end()) continue;
      note(entry.key_place, unknown_name_message("key", entry.key, point_names()));
    }
    for (std::size_t i = 0; root.kind == Node::Kind::kMap && i < 4; ++i) {
      const Node* point = root.find(point_names()[i]);
      if (point == nullptr) {
        note(root.place, fmt::format("found no {}, expected point1 … point4", point_names()[i]));
        continue;
      }
      limits.points_px[i] = {coordinate(*point, point_names()[i], "x"),
                             coordinate(*point, point_names()[i], "y")};
    }
    if (!mistakes_.empty()) throw ConfigError(std::move(mistakes_));
    return limits;
  }

 private:
  void note(const Place& place, std::string message) {
    mistakes_.push_back(mistake_at(place, std::move(message)));
  }

  double coordinate(const Node& point, std::string_view name, std::string_view axis) {
    constexpr double kMostPx = 65'535.0;
    const Node* node = point.find(axis);
    if (node == nullptr) {
      note(point.place, fmt::format("found no {} in {}, expected x and y", axis, name));
      return 0.0;
    }
    const auto number = node->kind == Node::Kind::kScalar && !node->quoted
                            ? parsed_number(node->scalar)
                            : std::variant<double, NumberFault>(NumberFault::kNotANumber);
    const double* value = std::get_if<double>(&number);
    if (value == nullptr || std::abs(*value) > kMostPx) {
      note(node->place, fmt::format("{}.{}: found {}, expected a number of pixels", name, axis,
                                    description_of(*node)));
      return 0.0;
    }
    return *value;
  }

  std::vector<Mistake> mistakes_;
};

}  // namespace

FieldLimits parse_field_limits(std::string_view text, std::string_view file_name) {
  return Reader().read(parse_document(text, file_name));
}

}  // namespace maggic
