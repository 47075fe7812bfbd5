#include "maggic/parameters.hpp"

#include <array>

namespace maggic {

void Parameters::number(const Parameter& what, std::optional<double>& value, Range<double> range) {
  double read = value.value_or(range.min);
  const bool given = present(what.key);
  // Described even when absent, so that printers list it and the reader knows the key.
  number(what, read, range);
  if (given) value = read;
}

void Parameters::integer(const Parameter& what, std::optional<int>& value, Range<int> range) {
  int read = value.value_or(range.min);
  const bool given = present(what.key);
  integer(what, read, range);
  if (given) value = read;
}

void Parameters::point(const Parameter& what, cv::Point2d& value, Range<double> range) {
  std::array<double, 2> xy{value.x, value.y};
  numbers(what, xy, range);
  value = {xy[0], xy[1]};
}

}  // namespace maggic
