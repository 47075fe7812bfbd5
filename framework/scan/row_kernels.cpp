#include "scan/row_kernels.hpp"

#include <bit>
#include <cstring>
#include <type_traits>

// All sets the compiler can make, plain code included, so that tests can compare them.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scan/row_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "scan/chunk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace maggic {
namespace HWY_NAMESPACE {

// The first `count` bits.
inline std::uint64_t first_bits(std::size_t count) {
  return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

// The labels of one chunk behind the last of the one before, and the run that is open.
class RunWriter {
 public:
  RunWriter(Run* out, std::uint16_t row) : out_(out), row_(row) {}

  // Where the next chunk's labels go.
  Label* chunk() { return labels_ + kLargestChunk; }

  // Takes the chunk's labels, the first of them at column x. A label that differs from its left
  // neighbour ends a run and may begin one; writing it before knowing whether it stays spares a
  // branch that noise would mispredict.
  HWY_INLINE void take_chunk(std::size_t x, std::size_t size) {
    labels_[kLargestChunk - 1] = last_;
    std::uint64_t changes = changes_of(chunk());
    while (changes != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(changes));
      changes &= changes - 1;
      const auto column = static_cast<std::uint16_t>(x + i);
      out_->end = column;
      out_ += is_open();
      last_ = chunk()[i];
      *out_ = Run{row_, column, 0, last_};
    }
    last_ = chunk()[size - 1];
  }

  // The pixels from column x on are background.
  void close(std::size_t x) {
    if (!is_open()) return;
    out_->end = static_cast<std::uint16_t>(x);
    ++out_;
    last_ = kBackground;
  }

  bool is_open() const { return last_ != kBackground; }
  Run* end() const { return out_; }

 private:
  alignas(64) Label labels_[2 * kLargestChunk] = {};
  Run* out_;
  std::uint16_t row_;
  Label last_ = kBackground;
};

template <bool kGated, bool kScaled>
class ColorChunks {
 public:
  static constexpr std::size_t kBytesAPixel = 3;

  explicit ColorChunks(const ColorLookUp& look_up) : look_up_(look_up) {}

  // Writes the labels of a chunk; false when all are background, and then it may write nothing.
  // @param wanted a bit for every pixel that counts.
  HWY_INLINE bool label(const std::uint8_t* bgr, std::uint64_t wanted, Label* chunk) {
    std::uint64_t candidates = find_candidates<kGated, kScaled>(bgr, look_up_, places_) & wanted;
    if (candidates == 0) return false;
    clear(chunk);
    while (candidates != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(candidates));
      candidates &= candidates - 1;
      const std::size_t block = look_up_.block_ids[places_.block[i]];
      chunk[i] = look_up_.block_labels[block << 9 | places_.within[i]];
    }
    return true;
  }

 private:
  const ColorLookUp& look_up_;
  Places places_;
};

class LabelChunks {
 public:
  static constexpr std::size_t kBytesAPixel = 1;

  HWY_INLINE bool label(const std::uint8_t* labels, std::uint64_t wanted, Label* chunk) {
    return (copy_labels(labels, chunk) & wanted) != 0;
  }
};

template <class Chunks>
void scan_spans(const PictureRows& picture, std::span<const RowSpan> area, Chunks&& chunks,
                RunBuffer& runs) {
  constexpr std::size_t kBytesAPixel = std::remove_cvref_t<Chunks>::kBytesAPixel;
  const std::size_t size = chunk_size();
  for (const RowSpan& span : area) {
    const std::uint8_t* row = picture.data + span.row * picture.step;
    // One more than there can be runs: the writer is always one ahead.
    RunWriter writer(runs.room_for(std::size_t{span.end} - span.begin + 1), span.row);
    const auto take = [&](const std::uint8_t* pixels, std::uint64_t wanted, std::size_t x) {
      if (chunks.label(pixels, wanted, writer.chunk())) {
        writer.take_chunk(x, size);
      } else {
        writer.close(x);
      }
    };
    std::size_t x = span.begin;
    for (; x + size <= span.end; x += size) take(row + kBytesAPixel * x, first_bits(size), x);
    if (const std::size_t rest = span.end - x; rest > 0) {
      // Nothing behind the span is read.
      alignas(64) std::uint8_t padded[kBytesAPixel * kLargestChunk] = {};
      std::memcpy(padded, row + kBytesAPixel * x, kBytesAPixel * rest);
      take(padded, first_bits(rest), x);
    }
    writer.close(span.end);
    runs.end_at(writer.end());
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
