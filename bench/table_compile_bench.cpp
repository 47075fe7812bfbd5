/// Time to compile the ColorTable on one and two threads, for every normalizer and segmenter that
/// ship, and again after a knob was turned; with copying 16 MiB as the yardstick. `memory_bytes` is
/// what the table takes, `asked` the share of the 2^24 colours that went through the stages.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

constexpr const char* kHuesOfNormalized = "{gray_threshold: 20, hue_of: normalized}";
constexpr const char* kMovedThreshold = "{gray_threshold: 21}";
constexpr const char* kMovedPivot =
    "{gray_threshold: 20, pivots: {red: 0, orange: 7, yellow: 44, green: 97, cyan: 140, blue: 151, "
    "magenta: 235}}";

/// Counts the colours a segmenter is asked for.
class CountingSegmenter final : public ColorSegmenter {
 public:
  explicit CountingSegmenter(const ColorSegmenter& stage) : stage_(stage) {}

  void segment(const ColorBatch& original, const ColorBatch& normalized,
               std::span<Label> labels) const override {
    asked_ += labels.size();
    stage_.segment(original, normalized, labels);
  }
  std::optional<Label> label_of(const ColorBox& original,
                                const ColorBox& normalized) const override {
    return stage_.label_of(original, normalized);
  }

  std::size_t asked() const { return asked_; }

 private:
  const ColorSegmenter& stage_;
  mutable std::atomic<std::size_t> asked_{0};
};

struct Case {
  const char* name;
  const char* segmenter;
  const char* yaml;
};

void compile_table(benchmark::State& state, const char* normalizer, const Case& with,
                   unsigned threads) {
  const auto normalizer_stage = testing::make<Normalizer>(normalizer);
  const auto segmenter_stage = testing::make<Segmenter>(with.segmenter, with.yaml);
  const auto& color_normalizer = dynamic_cast<const ColorNormalizer&>(*normalizer_stage);
  const auto& color_segmenter = dynamic_cast<const ColorSegmenter&>(*segmenter_stage);
  const std::size_t palette_size = testing::standard_palette().size();
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ColorTable::compile(color_normalizer, color_segmenter, palette_size, threads));
  }
  const CountingSegmenter counting(color_segmenter);
  const ColorTable table = ColorTable::compile(color_normalizer, counting, palette_size, threads);
  state.counters["memory_bytes"] =
      static_cast<double>(table.block_ids().size_bytes() + table.block_labels().size_bytes());
  state.counters["asked"] =
      static_cast<double>(counting.asked()) / static_cast<double>(ColorTable::kColors);
}

void copy_flat_table(benchmark::State& state) {
  const std::vector<Label> source(ColorTable::kColors, Label{1});
  std::vector<Label> target(source.size());
  for (auto _ : state) {
    std::memcpy(target.data(), source.data(), source.size());
    benchmark::DoNotOptimize(target.data());
    benchmark::ClobberMemory();
  }
}

// What a pipeline pays for besides the table when it starts.
void prepare_normalizer(benchmark::State& state, const char* normalizer) {
  for (auto _ : state) benchmark::DoNotOptimize(testing::make<Normalizer>(normalizer));
}

constexpr std::array<Case, 6> kCases{
    {{"hue_pivots", "hue_pivots", kPivots},
     {"hue_pivots_of_normalized", "hue_pivots", kHuesOfNormalized},
     {"hue_pivots_with_exclusions", "hue_pivots", kPivotsWithExclusions},
     {"hue_pivots_moved_threshold", "hue_pivots", kMovedThreshold},
     {"hue_pivots_moved_pivot", "hue_pivots", kMovedPivot},
     {"yuv_boxes", "yuv_boxes", kEightBoxes}}};

const bool kRegistered = [] {
  benchmark::RegisterBenchmark("memcpy_16mib", copy_flat_table)->Unit(benchmark::kMillisecond);
  for (const char* normalizer : {"none", "chromatic", "vector", "weighted"}) {
    for (const Case& with : kCases) {
      for (const unsigned threads : {1U, 2U}) {
        const std::string name =
            std::string(normalizer) + "/" + with.name + "/threads:" + std::to_string(threads);
        benchmark::RegisterBenchmark(name.c_str(), compile_table, normalizer, with, threads)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      }
    }
    benchmark::RegisterBenchmark((std::string("prepare/") + normalizer).c_str(), prepare_normalizer,
                                 normalizer)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace maggic
