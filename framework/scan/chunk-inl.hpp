/// What the scan does with a chunk of 64 neighbouring pixels at once, for one vector instruction
/// set: included once for each, by Highway's rules. Bit i of a 64-bit word stands for pixel i.

#if defined(MAGGIC_SCAN_CHUNK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MAGGIC_SCAN_CHUNK_INL_HPP
#undef MAGGIC_SCAN_CHUNK_INL_HPP
#else
#define MAGGIC_SCAN_CHUNK_INL_HPP
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#include "scan/row_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace maggic {
namespace HWY_NAMESPACE {

inline constexpr std::size_t kChunk = 64;

// A chunk's pixels as places in the table, in their order.
struct Places {
  alignas(64) std::uint16_t block[kChunk];
  alignas(64) std::uint16_t within[kChunk];
};

#if HWY_TARGET == HWY_SCALAR

// Plain code, for machines without any of the instruction sets; the compiler vectorises it as it
// can.
template <bool kScaled>
std::uint32_t channel(const std::uint8_t* pixel, std::size_t c, const ColorLookUp& look_up) {
  if constexpr (!kScaled) return pixel[c];
  return std::min((pixel[c] * std::uint32_t{look_up.gains_q12[c]} + 2048) >> 12,
                  std::uint32_t{255});
}

template <bool kScaled>
std::uint64_t find_candidates(const std::uint8_t* bgr, const ColorLookUp& look_up) {
  std::uint64_t candidates = 0;
  for (std::size_t i = 0; i < kChunk; ++i) {
    const std::uint32_t b = channel<kScaled>(bgr + 3 * i, 0, look_up);
    const std::uint32_t g = channel<kScaled>(bgr + 3 * i, 1, look_up);
    const std::uint32_t r = channel<kScaled>(bgr + 3 * i, 2, look_up);
    const std::uint32_t value = std::max(std::max(b, g), r);
    const std::uint32_t spread = value - std::min(std::min(b, g), r);
    const bool is_candidate = spread >= look_up.first_colored_spread[value >> 4];
    candidates |= std::uint64_t{is_candidate} << i;
  }
  return candidates;
}

template <bool kScaled>
void find_places(const std::uint8_t* bgr, const ColorLookUp& look_up, Places& places) {
  for (std::size_t i = 0; i < kChunk; ++i) {
    const std::uint32_t b = channel<kScaled>(bgr + 3 * i, 0, look_up);
    const std::uint32_t g = channel<kScaled>(bgr + 3 * i, 1, look_up);
    const std::uint32_t r = channel<kScaled>(bgr + 3 * i, 2, look_up);
    places.block[i] = static_cast<std::uint16_t>(b >> 3 | (g & 0xF8) << 2 | (r & 0xF8) << 7);
    places.within[i] = static_cast<std::uint16_t>((b & 7) | (g & 7) << 3 | (r & 7) << 6);
  }
}

inline std::uint64_t differing(const Label* labels, const Label* others) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kChunk; ++i) bits |= std::uint64_t{labels[i] != others[i]} << i;
  return bits;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, kChunk>;
using Words = hn::Repartition<std::uint16_t, Bytes>;
using ByteVector = hn::Vec<Bytes>;
using WordVector = hn::Vec<Words>;

HWY_INLINE std::uint64_t bits_of(hn::Mask<Bytes> mask) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(Bytes(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

struct Pixels {
  ByteVector b, g, r;
};

HWY_INLINE WordVector scaled_upper(WordVector values_q8, WordVector factor_q12) {
  const Words d;
  const WordVector half = hn::Set(d, std::uint16_t{8});
  const WordVector largest = hn::Set(d, std::uint16_t{255});
  return hn::Min(hn::ShiftRight<4>(hn::Add(hn::MulHigh(values_q8, factor_q12), half)), largest);
}

// See ChannelGains: (v·q + 2^11) >> 12 as ((256·v·q >> 16) + 8) >> 4, which is the same; bytes at
// even and odd places apart, so nothing has to be shuffled.
HWY_INLINE ByteVector scaled(ByteVector values, std::uint16_t factor_q12) {
  const Words d;
  const WordVector factor = hn::Set(d, factor_q12);
  const WordVector both = hn::BitCast(d, values);
  const WordVector even = scaled_upper(hn::ShiftLeft<8>(both), factor);
  const WordVector odd = scaled_upper(hn::And(both, hn::Set(d, std::uint16_t{0xFF00})), factor);
  return hn::BitCast(Bytes(), hn::Or(even, hn::ShiftLeft<8>(odd)));
}

template <bool kScaled>
HWY_INLINE Pixels load_pixels(const std::uint8_t* bgr, const ColorLookUp& look_up) {
  Pixels p;
  hn::LoadInterleaved3(Bytes(), bgr, p.b, p.g, p.r);
  if constexpr (kScaled) {
    p.b = scaled(p.b, look_up.gains_q12[0]);
    p.g = scaled(p.g, look_up.gains_q12[1]);
    p.r = scaled(p.r, look_up.gains_q12[2]);
  }
  return p;
}

// The pixels that the gate cannot tell to be background.
template <bool kScaled>
HWY_INLINE std::uint64_t find_candidates(const std::uint8_t* bgr, const ColorLookUp& look_up) {
  const Bytes d;
  const ByteVector first_by_value = hn::LoadDup128(d, look_up.first_colored_spread);
  const std::size_t lanes = hn::Lanes(d);
  std::uint64_t candidates = 0;
  for (std::size_t i = 0; i < kChunk; i += lanes) {
    const Pixels p = load_pixels<kScaled>(bgr + 3 * i, look_up);
    const ByteVector value = hn::Max(hn::Max(p.b, p.g), p.r);
    const ByteVector spread = hn::Sub(value, hn::Min(hn::Min(p.b, p.g), p.r));
    const ByteVector first = hn::TableLookupBytes(first_by_value, hn::ShiftRight<4>(value));
    candidates |= bits_of(hn::Eq(hn::Max(spread, first), spread)) << i;
  }
  return candidates;
}

HWY_INLINE WordVector bits(WordVector v, std::uint16_t mask) {
  return hn::And(v, hn::Set(Words(), mask));
}

// Where every pixel's label stands: bytes at even and odd places apart until they are stored.
template <bool kScaled>
HWY_INLINE void find_places(const std::uint8_t* bgr, const ColorLookUp& look_up, Places& places) {
  const Words d;
  const std::size_t lanes = hn::Lanes(Bytes());
  for (std::size_t i = 0; i < kChunk; i += lanes) {
    const Pixels p = load_pixels<kScaled>(bgr + 3 * i, look_up);
    const WordVector b = hn::BitCast(d, p.b);
    const WordVector g = hn::BitCast(d, p.g);
    const WordVector r = hn::BitCast(d, p.r);
    const WordVector even_blocks =
        hn::Or(bits(hn::ShiftRight<3>(b), 0x1F),
               hn::Or(hn::ShiftLeft<2>(bits(g, 0xF8)), hn::ShiftLeft<7>(bits(r, 0xF8))));
    const WordVector odd_blocks =
        hn::Or(hn::ShiftRight<11>(b),
               hn::Or(bits(hn::ShiftRight<6>(g), 0x3E0), bits(hn::ShiftRight<1>(r), 0x7C00)));
    const WordVector even_within =
        hn::Or(bits(b, 7), hn::Or(hn::ShiftLeft<3>(bits(g, 7)), hn::ShiftLeft<6>(bits(r, 7))));
    const WordVector odd_within =
        hn::Or(bits(hn::ShiftRight<8>(b), 7),
               hn::Or(bits(hn::ShiftRight<5>(g), 0x38), bits(hn::ShiftRight<2>(r), 0x1C0)));
    hn::StoreInterleaved2(even_blocks, odd_blocks, d, places.block + i);
    hn::StoreInterleaved2(even_within, odd_within, d, places.within + i);
  }
}

// Where two rows of labels differ.
HWY_INLINE std::uint64_t differing(const Label* labels, const Label* others) {
  const Bytes d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kChunk; i += lanes) {
    bits |= bits_of(hn::Ne(hn::LoadU(d, labels + i), hn::LoadU(d, others + i))) << i;
  }
  return bits;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace maggic
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
