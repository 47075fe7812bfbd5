#include "maggic/color_temperature.hpp"

namespace maggic {
namespace {

double cubic(double v, double a, double b, double c, double d) {
  return ((a * v + b) * v + c) * v + d;
}

std::array<double, 3> linear_srgb(double kelvin) {
  const double k = 1000.0 / kelvin;
  const double x = kelvin < 4000.0 ? cubic(k, -0.2661239, -0.2343589, 0.8776956, 0.179910)
                                   : cubic(k, -3.0258469, 2.1070379, 0.2226347, 0.240390);
  const double y = kelvin < 2222.0   ? cubic(x, -1.1063814, -1.34811020, 2.18555832, -0.20219683)
                   : kelvin < 4000.0 ? cubic(x, -0.9549476, -1.37418593, 2.09137015, -0.16748867)
                                     : cubic(x, 3.0817580, -5.87338670, 3.75112997, -0.37001483);
  const double big_x = x / y;  // at Y = 1
  const double big_z = (1.0 - x - y) / y;
  return {3.2406 * big_x - 1.5372 - 0.4986 * big_z, -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
          0.0557 * big_x - 0.2040 + 1.0570 * big_z};
}

}  // namespace

std::array<double, 3> lamp_gains(double kelvin) {
  const std::array<double, 3> lamp = linear_srgb(kelvin);
  const std::array<double, 3> white = linear_srgb(kWhiteKelvin);
  const double green = lamp[1] / white[1];
  return {lamp[0] / white[0] / green, 1.0, lamp[2] / white[2] / green};
}

}  // namespace maggic
