#include <cstring>
#include <vector>

#include "maggic/speed_measurement.hpp"
#include "measurement/samples.hpp"

namespace maggic {

std::optional<TableSpeed> measure_table(const Pipeline& pipeline, const ColorSegmenter* changed,
                                        unsigned threads, int repetitions) {
  const PipelineParts& parts = pipeline.parts();
  const auto* normalizer = dynamic_cast<const ColorNormalizer*>(parts.normalizer.stage.get());
  const auto* segmenter = dynamic_cast<const ColorSegmenter*>(parts.segmenter.stage.get());
  if (normalizer == nullptr || segmenter == nullptr) return std::nullopt;
  const auto compile = [&](const ColorSegmenter& with, unsigned on) {
    const ColorTable table = ColorTable::compile(*normalizer, with, parts.palette.size(), on);
  };

  const auto count = static_cast<std::size_t>(repetitions);
  Samples alone(count);
  Samples shared(count);
  Samples update(count);
  Samples copy(count);
  const std::vector<Label> source(ColorTable::kColors, Label{1});
  std::vector<Label> target(source.size());
  for (int i = 0; i < repetitions; ++i) {
    alone.time([&] { compile(*segmenter, 1); });
    shared.time([&] { compile(*segmenter, threads); });
    update.time([&] { compile(changed != nullptr ? *changed : *segmenter, 1); });
    copy.time([&] { std::memcpy(target.data(), source.data(), source.size()); });
  }
  return TableSpeed{alone.figures(), shared.figures(), update.figures(), copy.figures()};
}

}  // namespace maggic
