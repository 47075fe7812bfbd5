#include "maggic/parameters.hpp"

#include <array>

namespace maggic {

void Parameters::number(const Parameter& what, std::optional<double>& value, Range<double> range) {
  visit_optional(what, value, [&](double& read) { number(what, read, range); });
}

void Parameters::integer(const Parameter& what, std::optional<int>& value, Range<int> range) {
  visit_optional(what, value, [&](int& read) { integer(what, read, range); });
}

void Parameters::point(const Parameter& what, cv::Point2d& value, Range<double> range) {
  std::array<double, 2> xy{value.x, value.y};
  numbers(what, xy, range);
  value = {xy[0], xy[1]};
}

void Parameters::point(const Parameter& what, std::optional<cv::Point2d>& value,
                       Range<double> range) {
  visit_optional(what, value, [&](cv::Point2d& read) { point(what, read, range); });
}

}  // namespace maggic
