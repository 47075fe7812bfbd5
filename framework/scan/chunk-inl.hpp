/// What the scan does with a chunk of neighbouring pixels at once, for one vector instruction set:
/// included once for each, by Highway's rules.

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

// A 64-bit word holds a bit for each pixel of a chunk.
inline constexpr std::size_t kLargestChunk = 64;

// A chunk's pixels as places in the table, in their order.
struct Places {
  alignas(64) std::uint16_t block[kLargestChunk];
  alignas(64) std::uint16_t within[kLargestChunk];
};

#if HWY_TARGET == HWY_SCALAR

// Plain code, for machines without any of the instruction sets; the compiler vectorises it as it
// can.
inline std::size_t chunk_size() { return kLargestChunk; }

template <bool kGated, bool kScaled>
std::uint64_t find_candidates(const std::uint8_t* bgr, const ColorLookUp& look_up, Places& places) {
  std::uint64_t candidates = kGated ? 0 : ~std::uint64_t{0};
  for (std::size_t i = 0; i < kLargestChunk; ++i) {
    std::uint32_t c[3] = {bgr[3 * i], bgr[3 * i + 1], bgr[3 * i + 2]};
    if constexpr (kScaled) {
      for (std::size_t k = 0; k < 3; ++k) {
        c[k] = std::min((c[k] * look_up.gains_q12[k] + 2048) >> 12, std::uint32_t{255});
      }
    }
    if constexpr (kGated) {
      const std::uint32_t value = std::max({c[0], c[1], c[2]});
      const std::uint32_t spread = value - std::min({c[0], c[1], c[2]});
      const bool is_candidate = spread >= look_up.first_colored_spread[value >> 4];
      candidates |= std::uint64_t{is_candidate} << i;
    }
    places.block[i] =
        static_cast<std::uint16_t>(c[0] >> 3 | (c[1] & 0xF8) << 2 | (c[2] & 0xF8) << 7);
    places.within[i] = static_cast<std::uint16_t>((c[0] & 7) | (c[1] & 7) << 3 | (c[2] & 7) << 6);
  }
  return candidates;
}

inline void clear(Label* chunk) { std::memset(chunk, kBackground, kLargestChunk); }

inline std::uint64_t copy_labels(const Label* source, Label* chunk) {
  std::memcpy(chunk, source, kLargestChunk);
  std::uint64_t colored = 0;
  for (std::size_t i = 0; i < kLargestChunk; ++i) colored |= std::uint64_t{source[i] != 0} << i;
  return colored;
}

inline std::uint64_t changes_of(const Label* chunk) {
  std::uint64_t changes = 0;
  for (std::size_t i = 0; i < kLargestChunk; ++i) {
    changes |= std::uint64_t{chunk[i] != *(chunk + i - 1)} << i;
  }
  return changes;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, kLargestChunk>;
using Words = hn::Repartition<std::uint16_t, Bytes>;
using ByteVector = hn::Vec<Bytes>;
using WordVector = hn::Vec<Words>;

HWY_INLINE std::size_t chunk_size() { return hn::Lanes(Bytes()); }

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

HWY_INLINE std::uint64_t may_be_colored(const Pixels& p, const std::uint8_t* first_colored_spread) {
  const Bytes d;
  const ByteVector value = hn::Max(hn::Max(p.b, p.g), p.r);
  const ByteVector spread = hn::Sub(value, hn::Min(hn::Min(p.b, p.g), p.r));
  const ByteVector table = hn::LoadDup128(d, first_colored_spread);
  const ByteVector first = hn::TableLookupBytes(table, hn::ShiftRight<4>(value));
  return bits_of(hn::Eq(hn::Max(spread, first), spread));
}

HWY_INLINE WordVector bits(WordVector v, std::uint16_t mask) {
  return hn::And(v, hn::Set(Words(), mask));
}

HWY_INLINE void find_places(const Pixels& p, Places& places) {
  const Words d;
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
  hn::StoreInterleaved2(even_blocks, odd_blocks, d, places.block);
  hn::StoreInterleaved2(even_within, odd_within, d, places.within);
}

// A bit for every pixel that the gate cannot tell to be background, and where its label stands.
// The places are not written when there is none.
template <bool kGated, bool kScaled>
HWY_INLINE std::uint64_t find_candidates(const std::uint8_t* bgr, const ColorLookUp& look_up,
                                         Places& places) {
  Pixels p;
  hn::LoadInterleaved3(Bytes(), bgr, p.b, p.g, p.r);
  if constexpr (kScaled) {
    p.b = scaled(p.b, look_up.gains_q12[0]);
    p.g = scaled(p.g, look_up.gains_q12[1]);
    p.r = scaled(p.r, look_up.gains_q12[2]);
  }
  std::uint64_t candidates = ~std::uint64_t{0};
  if constexpr (kGated) {
    candidates = may_be_colored(p, look_up.first_colored_spread);
    if (candidates == 0) return 0;
  }
  find_places(p, places);
  return candidates;
}

HWY_INLINE void clear(Label* chunk) { hn::Store(hn::Zero(Bytes()), Bytes(), chunk); }

// Copies a chunk of labels. @return a bit for every one that is not background.
HWY_INLINE std::uint64_t copy_labels(const Label* source, Label* chunk) {
  const ByteVector labels = hn::LoadU(Bytes(), source);
  hn::Store(labels, Bytes(), chunk);
  return bits_of(hn::Ne(labels, hn::Zero(Bytes())));
}

// A bit for every label that differs from its left neighbour, the first from the one before the
// chunk.
HWY_INLINE std::uint64_t changes_of(const Label* chunk) {
  return bits_of(hn::Ne(hn::Load(Bytes(), chunk), hn::LoadU(Bytes(), chunk - 1)));
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace maggic
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
