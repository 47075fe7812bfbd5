/// libFuzzer target: whatever the bytes, reading a truth file ends, in a Truth or a ConfigError.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "maggic/truth_file.hpp"

namespace {

void expect(bool holds) {
  if (!holds) std::abort();
}

void expect_usable(const maggic::TrueScene& scene) {
  expect(scene.robots.size() <= maggic::kMaxTrueRobots);
  for (const maggic::TrueRobot& robot : scene.robots) {
    expect(robot.centroid_px || robot.position_mm);
    if (robot.centroid_px) expect(std::isfinite(robot.centroid_px->x + robot.centroid_px->y));
    if (robot.position_mm) expect(std::isfinite(robot.position_mm->x + robot.position_mm->y));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const maggic::Palette palette = maggic::Palette::standard();
  try {
    const maggic::Truth truth = maggic::parse_truth(text, "fuzz.json", palette);
    expect(truth.size_px.width >= 1 && truth.size_px.height >= 1);
    expect(truth.tolerance.distance > 0.0);
    if (truth.every_frame) expect_usable(*truth.every_frame);
    for (const auto& [number, scene] : truth.frames) expect_usable(scene);
  } catch (const maggic::ConfigError& e) {
    expect(!e.mistakes().empty());
  }
  return 0;
}
