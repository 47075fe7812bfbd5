/// Time to compile the ColorTable on one core, for every normalizer and segmenter that ship.

#include <string>

#include <benchmark/benchmark.h>

#include "maggic/color_table.hpp"
#include "maggic/testing.hpp"

namespace maggic {
namespace {

constexpr const char* kPivots = "{gray_threshold: 20}";
constexpr const char* kPivotsWithExclusions =
    "{gray_threshold: 20, exclude: [{hue: [5, 20], value: [0, 90]}, "
    "{hue: [250, 10], saturation: [0, 60]}]}";
constexpr const char* kEightBoxes =
    "{gray_threshold: 20, boxes: {orange: {y: [60, 200], u: [40, 110], v: [170, 240]}, "
    "blue: {y: [20, 120], u: [150, 255], v: [60, 130]}, "
    "yellow: {y: [140, 255], u: [0, 90], v: [110, 170]}, "
    "red: {y: [30, 140], u: [70, 130], v: [180, 255]}, "
    "green: {y: [40, 220], u: [30, 110], v: [0, 100]}, "
    "magenta: {y: [40, 180], u: [120, 220], v: [160, 255]}, "
    "cyan: {y: [90, 240], u: [120, 210], v: [0, 110]}, "
    "purple: {y: [10, 110], u: [130, 200], v: [120, 180]}}}";

void compile_table(benchmark::State& state, const char* normalizer, const char* segmenter,
                   const char* yaml) {
  const auto normalizer_stage = testing::make<Normalizer>(normalizer);
  const auto segmenter_stage = testing::make<Segmenter>(segmenter, yaml);
  const auto& color_normalizer = dynamic_cast<const ColorNormalizer&>(*normalizer_stage);
  const auto& color_segmenter = dynamic_cast<const ColorSegmenter&>(*segmenter_stage);
  const std::size_t palette_size = testing::standard_palette().size();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ColorTable::compile(color_normalizer, color_segmenter, palette_size, 1));
  }
}

// What a pipeline pays for besides the table when it starts.
void prepare_normalizer(benchmark::State& state, const char* normalizer) {
  for (auto _ : state) benchmark::DoNotOptimize(testing::make<Normalizer>(normalizer));
}

const bool kRegistered = [] {
  for (const char* normalizer : {"none", "chromatic", "vector", "weighted"}) {
    const auto add = [&](const char* segmenter, const char* variant, const char* yaml) {
      const std::string name = std::string(normalizer) + "/" + segmenter + variant;
      benchmark::RegisterBenchmark(name.c_str(), compile_table, normalizer, segmenter, yaml)
          ->Unit(benchmark::kMillisecond);
    };
    add("hue_pivots", "", kPivots);
    add("hue_pivots", "_with_exclusions", kPivotsWithExclusions);
    add("yuv_boxes", "", kEightBoxes);
    benchmark::RegisterBenchmark((std::string("prepare/") + normalizer).c_str(), prepare_normalizer,
                                 normalizer)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace maggic
