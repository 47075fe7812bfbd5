#include "scan/row_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "maggic/color_table.hpp"

// All sets the compiler can make, plain code included, so that tests can compare them.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scan/row_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scan/chunk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace maggic {
namespace HWY_NAMESPACE {

// So many chunks are looked through for colour before the first of them is looked up: what a
// branch predictor cannot know then does not hold up the reading, and the pixels are still near.
inline constexpr std::size_t kChunksAhead = 32;

// How far ahead pixels are asked for. The machine's own prefetching ends with every page.
inline constexpr std::size_t kPrefetchBytes = 8192;

// The labels of a chunk behind that of the pixel before it.
class ChunkLabels {
 public:
  Label* labels() { return all_ + 1; }
  void set_before(Label label) { all_[0] = label; }

  // Every label that differs from its left neighbour.
  HWY_INLINE std::uint64_t borders() const { return differing(all_ + 1, all_); }

 private:
  Label all_[kChunk + 1];
};

// Writes the runs of one span, chunk by chunk.
class RunWriter {
 public:
  RunWriter(Run* out, std::uint16_t row) : out_(out), row_(row) {}

  Run* end() const { return out_; }

  // Takes a chunk whose first pixel is column x and follows the one before.
  HWY_INLINE void take(ChunkLabels& chunk, std::size_t x) {
    chunk.set_before(last_);
    std::uint64_t borders = chunk.borders();
    while (borders != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(borders));
      borders &= borders - 1;
      const auto column = static_cast<std::uint16_t>(x + i);
      // Written before it is known to stay: spares a branch that noise would mispredict.
      out_->end = column;
      out_ += last_ != kBackground;
      last_ = chunk.labels()[i];
      *out_ = Run{row_, column, 0, last_};
    }
  }

  // The pixels from column x on are background.
  HWY_INLINE void close(std::size_t x) {
    if (last_ == kBackground) return;
    out_->end = static_cast<std::uint16_t>(x);
    ++out_;
    last_ = kBackground;
  }

 private:
  Run* out_;
  std::uint16_t row_;
  Label last_ = kBackground;
};

template <bool kGated, bool kScaled>
class ColorChunks {
 public:
  static constexpr std::size_t kBytesAPixel = 3;

  explicit ColorChunks(const ColorLookUp& look_up) : look_up_(look_up) {}

  // Which pixels of a chunk are worth a look.
  HWY_INLINE std::uint64_t candidates(const std::uint8_t* bgr) const {
    if constexpr (!kGated) return ~std::uint64_t{0};
    return find_candidates<kScaled>(bgr, look_up_);
  }

  HWY_INLINE void label(const std::uint8_t* bgr, std::uint64_t candidates, Label* labels) {
    find_places<kScaled>(bgr, look_up_, places_);
    std::memset(labels, kBackground, kChunk);
    while (candidates != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(candidates));
      candidates &= candidates - 1;
      const std::size_t block = look_up_.block_ids[places_.block[i]];
      labels[i] = look_up_.block_labels[block * ColorTable::kColorsPerBlock + places_.within[i]];
    }
  }

 private:
  const ColorLookUp& look_up_;
  Places places_;
};

class LabelChunks {
 public:
  static constexpr std::size_t kBytesAPixel = 1;

  HWY_INLINE std::uint64_t candidates(const Label* labels) const {
    return differing(labels, background_);
  }

  HWY_INLINE void label(const Label* source, std::uint64_t /*candidates*/, Label* labels) const {
    std::memcpy(labels, source, kChunk);
  }

 private:
  alignas(64) Label background_[kChunk] = {};
};

// Appends the runs of one span.
template <class Chunks>
HWY_INLINE void scan_span(const std::uint8_t* row, const RowSpan& span, Chunks& chunks,
                          RunBuffer& runs) {
  constexpr std::size_t kBytes = Chunks::kBytesAPixel;
  // One more than there can be runs: the writer is always one ahead.
  RunWriter writer(runs.room_for(std::size_t{span.end} - span.begin + 1), span.row);
  ChunkLabels chunk;
  const auto look_up = [&](const std::uint8_t* pixels, std::uint64_t candidates, std::size_t x) {
    chunks.label(pixels, candidates, chunk.labels());
    writer.take(chunk, x);
  };
  std::size_t x = span.begin;
  std::uint64_t candidates[kChunksAhead];
  while (x + kChunk <= span.end) {
    const std::size_t count = std::min(kChunksAhead, (span.end - x) / kChunk);
    std::uint64_t worth_a_look = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* pixels = row + kBytes * (x + i * kChunk);
      for (std::size_t line = 0; line < kBytes; ++line) {
        hwy::Prefetch(pixels + kPrefetchBytes + line * kChunk);
      }
      candidates[i] = chunks.candidates(pixels);
      worth_a_look |= std::uint64_t{candidates[i] != 0} << i;
    }
    std::size_t next = 0;
    while (worth_a_look != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(worth_a_look));
      worth_a_look &= worth_a_look - 1;
      if (i != next) writer.close(x + next * kChunk);
      look_up(row + kBytes * (x + i * kChunk), candidates[i], x + i * kChunk);
      next = i + 1;
    }
    if (next != count) writer.close(x + next * kChunk);
    x += count * kChunk;
  }
  if (const std::size_t rest = span.end - x; rest > 0) {
    // Nothing behind the span is read.
    alignas(64) std::uint8_t padded[kBytes * kChunk] = {};
    std::memcpy(padded, row + kBytes * x, kBytes * rest);
    const std::uint64_t within = (std::uint64_t{1} << rest) - 1;
    look_up(padded, chunks.candidates(padded) & within, x);
  }
  writer.close(span.end);
  runs.end_at(writer.end());
}

template <class Chunks>
void scan_spans(const PictureRows& picture, std::span<const RowSpan> area, Chunks&& chunks,
                RunBuffer& runs) {
  for (const RowSpan& span : area) {
    scan_span(picture.data + span.row * picture.step, span, chunks, runs);
  }
}

void scan_color_spans(const PictureRows& bgr, std::span<const RowSpan> area,
                      const ColorLookUp& look_up, RunBuffer& runs) {
  const bool gated = look_up.first_colored_spread != nullptr;
  const bool scaled = look_up.gains_q12 != nullptr;
  if (gated && !scaled) return scan_spans(bgr, area, ColorChunks<true, false>(look_up), runs);
  if (gated) return scan_spans(bgr, area, ColorChunks<true, true>(look_up), runs);
  if (scaled) return scan_spans(bgr, area, ColorChunks<false, true>(look_up), runs);
  scan_spans(bgr, area, ColorChunks<false, false>(look_up), runs);
}

void scan_label_spans(const PictureRows& labels, std::span<const RowSpan> area, RunBuffer& runs) {
  scan_spans(labels, area, LabelChunks(), runs);
}

}  // namespace HWY_NAMESPACE
}  // namespace maggic
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace maggic {
namespace {

HWY_EXPORT(scan_color_spans);
HWY_EXPORT(scan_label_spans);

}  // namespace

void scan_colors(const PictureRows& bgr, std::span<const RowSpan> area, const ColorLookUp& look_up,
                 RunBuffer& runs) {
  HWY_DYNAMIC_DISPATCH(scan_color_spans)(bgr, area, look_up, runs);
}

void scan_labels(const PictureRows& labels, std::span<const RowSpan> area, RunBuffer& runs) {
  HWY_DYNAMIC_DISPATCH(scan_label_spans)(labels, area, runs);
}

}  // namespace maggic
#endif  // HWY_ONCE
