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

// Chunks with colour wait until there are so many, from as many rows as it takes: then the table's
// cache lines are asked for all at once, and what a branch predictor cannot know holds up no
// reading.
inline constexpr std::size_t kBatch = 32;

// They wait no longer than this, so that their pixels are still near: 96 KiB of them.
inline constexpr std::size_t kChunksAhead = 512;

// Bits of a word: so many chunks of a row are looked through for colour at once.
inline constexpr std::size_t kWord = 64;

// How far ahead pixels are asked for. The machine's own prefetching ends with every page.
inline constexpr std::size_t kPrefetchBytes = 8192;

// A chunk, or a span's rest, with pixels that may have a label.
struct ColoredChunk {
  const std::uint8_t* pixels;
  std::uint64_t candidates;
  std::uint16_t row;
  std::uint16_t begin;
  std::uint16_t end;

  bool follows(const ColoredChunk& other) const { return row == other.row && begin == other.end; }
};

// Writes the runs of chunks that come in the picture's order.
class RunWriter {
 public:
  // From now on to `out`; a run may be open.
  void write_to(Run* out) {
    out_ = out;
    *out_ = open_;
  }

  // Behind the last run that is complete.
  Run* end() {
    open_ = *out_;
    return out_;
  }

  Label last() const { return last_; }

  // Takes a chunk's labels, which begin where `borders` says that they differ from their left
  // neighbour.
  HWY_INLINE void take(const ColoredChunk& chunk, const Label* labels, std::uint64_t borders) {
    while (borders != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(borders));
      borders &= borders - 1;
      const auto column = static_cast<std::uint16_t>(chunk.begin + i);
      // Written before it is known to stay: spares a branch that noise would mispredict.
      out_->end = column;
      out_ += last_ != kBackground;
      last_ = labels[i];
      *out_ = Run{chunk.row, column, 0, last_};
    }
  }

  // The pixels from `column` on are background.
  HWY_INLINE void close(std::uint16_t column) {
    if (last_ == kBackground) return;
    out_->end = column;
    ++out_;
    last_ = kBackground;
  }

 private:
  Run* out_ = nullptr;
  Run open_{};
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

  // Writes the chunks' labels side by side.
  HWY_INLINE void label(std::span<const ColoredChunk> chunks, Label* labels) {
    // Held in locals: a label that is stored could be any byte of the look-up, as the compiler sees
    // it.
    const std::uint16_t* const block_ids = look_up_.block_ids;
    const Label* const block_labels = look_up_.block_labels;
    const Label** at = at_;
    for (const ColoredChunk& chunk : chunks) {
      find_places<kScaled>(chunk.pixels, look_up_, places_);
      for (std::uint64_t left = chunk.candidates; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        const std::size_t block = block_ids[places_.block[i]];
        *at = block_labels + block * ColorTable::kColorsPerBlock + places_.within[i];
        hwy::Prefetch(*at);
        ++at;
      }
    }
    std::memset(labels, kBackground, chunks.size() * kChunk);
    const Label* const* from = at_;
    for (const ColoredChunk& chunk : chunks) {
      for (std::uint64_t left = chunk.candidates; left != 0; left &= left - 1) {
        labels[std::countr_zero(left)] = **from++;
      }
      labels += kChunk;
    }
  }

 private:
  const ColorLookUp& look_up_;
  Places places_;                     // Of one chunk.
  const Label* at_[kBatch * kChunk];  // Where the candidates' labels stand.
};

class LabelChunks {
 public:
  static constexpr std::size_t kBytesAPixel = 1;

  HWY_INLINE std::uint64_t candidates(const Label* labels) const {
    return differing(labels, background_);
  }

  HWY_INLINE void label(std::span<const ColoredChunk> chunks, Label* labels) const {
    for (const ColoredChunk& chunk : chunks) {
      std::memcpy(labels, chunk.pixels, kChunk);
      labels += kChunk;
    }
  }

 private:
  alignas(64) Label background_[kChunk] = {};
};

// Turns chunks into runs, many at a time.
template <class Chunks>
class ChunkBatch {
 public:
  static constexpr std::size_t kBytes = Chunks::kBytesAPixel;

  ChunkBatch(Chunks& chunks, RunBuffer& runs) : chunks_(chunks), runs_(runs) {
    all_labels_[0] = kBackground;
  }

  // The next pixels of a row, 64 a chunk and no more than kWord chunks.
  HWY_INLINE void add(const std::uint8_t* pixels, std::size_t count, std::size_t row,
                      std::size_t begin) {
    std::uint64_t candidates[kWord];
    std::uint64_t worth_a_look = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* chunk = pixels + kBytes * kChunk * i;
      for (std::size_t line = 0; line < kBytes; ++line) {
        hwy::Prefetch(chunk + kPrefetchBytes + line * kChunk);
      }
      candidates[i] = chunks_.candidates(chunk);
      worth_a_look |= std::uint64_t{candidates[i] != 0} << i;
    }
    for (; worth_a_look != 0; worth_a_look &= worth_a_look - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(worth_a_look));
      const std::size_t x = begin + i * kChunk;
      waiting_[size_++] = {pixels + kBytes * kChunk * i, candidates[i],
                           static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(x),
                           static_cast<std::uint16_t>(x + kChunk)};
      if (size_ == kBatch) write_runs();
    }
    passed_ += count;
    if (passed_ >= kChunksAhead) write_runs();
  }

  // The last pixels of a span, fewer than 64. Nothing behind them is read.
  void add_rest(const std::uint8_t* pixels, std::size_t row, std::size_t begin, std::size_t count) {
    std::uint8_t* padded = rests_[size_];
    std::memcpy(padded, pixels, kBytes * count);
    std::memset(padded + kBytes * count, 0, kBytes * (kChunk - count));
    const std::uint64_t within = (std::uint64_t{1} << count) - 1;
    waiting_[size_] = {padded, chunks_.candidates(padded) & within, static_cast<std::uint16_t>(row),
                       static_cast<std::uint16_t>(begin),
                       static_cast<std::uint16_t>(begin + count)};
    size_ += waiting_[size_].candidates != 0;
    if (size_ == kBatch) write_runs();
  }

  void finish() {
    write_runs();
    writer_.write_to(runs_.room_for(1));
    writer_.close(last_.end);
    runs_.end_at(writer_.end());
  }

 private:
  void write_runs() {
    Label* labels = all_labels_ + 1;
    chunks_.label(std::span(waiting_, size_), labels);
    // A copy: labels that are stored could be any byte of a member, as the compiler sees it.
    RunWriter writer = writer_;
    // One more than there can be runs: the writer is always one ahead.
    writer.write_to(runs_.room_for(size_ * kChunk + 1));
    const ColoredChunk* last = &last_;
    for (const ColoredChunk& chunk : std::span(waiting_, size_)) {
      if (!chunk.follows(*last)) writer.close(last->end);
      // A store that vectors are loaded over right away costs as much as the rest.
      if (labels[-1] != writer.last()) labels[-1] = writer.last();
      writer.take(chunk, labels, differing(labels, labels - 1));
      labels += kChunk;
      last = &chunk;
    }
    last_ = *last;
    runs_.end_at(writer.end());
    writer_ = writer;
    size_ = 0;
    passed_ = 0;
  }

  Chunks& chunks_;
  RunBuffer& runs_;
  RunWriter writer_;
  ColoredChunk last_{};
  std::size_t size_ = 0;
  std::size_t passed_ = 0;
  ColoredChunk waiting_[kBatch];
  Label all_labels_[kBatch * kChunk + 1];
  alignas(64) std::uint8_t rests_[kBatch][kBytes * kChunk];
};

template <class Chunks>
void scan_spans(const PictureRows& picture, std::span<const RowSpan> area, Chunks&& chunks,
                RunBuffer& runs) {
  ChunkBatch<Chunks> batch(chunks, runs);
  for (const RowSpan& span : area) {
    const std::uint8_t* row = picture.data + span.row * picture.step;
    std::size_t x = span.begin;
    while (x + kChunk <= span.end) {
      const std::size_t count = std::min(kWord, (span.end - x) / kChunk);
      batch.add(row + Chunks::kBytesAPixel * x, count, span.row, x);
      x += count * kChunk;
    }
    if (x < span.end) {
      batch.add_rest(row + Chunks::kBytesAPixel * x, span.row, x, span.end - x);
    }
  }
  batch.finish();
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
