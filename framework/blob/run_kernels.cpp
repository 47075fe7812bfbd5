#include "blob/run_kernels.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

// All sets the compiler can make, plain code included, so that tests can compare them.
#define HWY_COMPILE_ALL_ATTAINABLE
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blob/run_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef MAGGIC_BLOB_RUN_KERNELS_TABLE
#define MAGGIC_BLOB_RUN_KERNELS_TABLE
namespace maggic {

// By a mask of eight lanes: the numbers of the lanes that are set, then zeros. Highway's own
// Compress (1.0.3) copies its table to the stack at every call.
inline constexpr auto kFirstSet = [] {
  std::array<std::array<std::uint64_t, 8>, 256> first_set{};
  for (std::size_t mask = 0; mask < first_set.size(); ++mask) {
    std::size_t count = 0;
    for (std::uint64_t lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1) != 0) first_set[mask][count++] = lane;
    }
  }
  return first_set;
}();

}  // namespace maggic
#endif  // MAGGIC_BLOB_RUN_KERNELS_TABLE

HWY_BEFORE_NAMESPACE();
namespace maggic {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

// A run a lane, read as one number.
const hn::CappedTag<std::uint64_t, 8> kLanes;
const hn::RebindToSigned<decltype(kLanes)> kSigned;
const hn::Repartition<std::uint8_t, decltype(kLanes)> kBytes;

static_assert(sizeof(Run) == sizeof(std::uint64_t) && std::is_trivially_copyable_v<Run>);
static_assert(offsetof(Run, begin) == 2 && offsetof(Run, end) == 4);
static_assert(std::endian::native == std::endian::little);

HWY_INLINE auto load(const Run* runs) {
  return hn::BitCast(kLanes, hn::LoadU(kBytes, reinterpret_cast<const std::uint8_t*>(runs)));
}

template <class Runs>
HWY_INLINE auto reach(Runs runs, int shortest_px) {
  const auto length_px =
      hn::And(hn::Sub(hn::ShiftRight<32>(runs), hn::ShiftRight<16>(runs)), hn::Set(kLanes, 0xffff));
  // Signed, which more sets have; a length is positive either way.
  return hn::RebindMask(kLanes,
                        hn::Gt(hn::BitCast(kSigned, length_px), hn::Set(kSigned, shortest_px - 1)));
}

#endif

inline bool reaches(const Run& run, int shortest_px) { return run.end - run.begin >= shortest_px; }

std::size_t count_runs(std::span<const Run> runs, int shortest_px) {
  std::size_t count = 0;
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const std::size_t lanes = hn::Lanes(kLanes);
  auto counts = hn::Zero(kLanes);
  for (; i + lanes <= runs.size(); i += lanes) {
    const auto one = hn::Set(kLanes, 1);
    const auto reaching = reach(load(runs.data() + i), shortest_px);
    counts = hn::Add(counts, hn::IfThenElseZero(reaching, one));
  }
  count = static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(kLanes, counts)));
#endif
  for (; i < runs.size(); ++i) count += reaches(runs[i], shortest_px) ? 1 : 0;
  return count;
}

std::size_t copy_runs(std::span<const Run> runs, int shortest_px, Run* kept) {
  std::size_t count = 0;
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const std::size_t lanes = hn::Lanes(kLanes);
  for (; i + lanes <= runs.size(); i += lanes) {
    const auto group = load(runs.data() + i);
    std::uint8_t bits[8];
    hn::StoreMaskBits(kLanes, reach(group, shortest_px), bits);
    const auto order = hn::LoadU(kLanes, kFirstSet[bits[0]].data());
    const auto first = hn::TableLookupLanes(group, hn::IndicesFromVec(kLanes, order));
    hn::StoreU(hn::BitCast(kBytes, first), kBytes, reinterpret_cast<std::uint8_t*>(kept + count));
    count += static_cast<std::size_t>(std::popcount(bits[0]));
  }
#endif
  for (; i < runs.size(); ++i) {
    kept[count] = runs[i];
    count += reaches(runs[i], shortest_px) ? 1 : 0;
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace maggic
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace maggic {
namespace {

HWY_EXPORT(count_runs);
HWY_EXPORT(copy_runs);

}  // namespace

std::size_t count_reaching(std::span<const Run> runs, int shortest_px) {
  return HWY_DYNAMIC_DISPATCH(count_runs)(runs, shortest_px);
}

std::size_t copy_reaching(std::span<const Run> runs, int shortest_px, Run* kept) {
  return HWY_DYNAMIC_DISPATCH(copy_runs)(runs, shortest_px, kept);
}

}  // namespace maggic
#endif  // HWY_ONCE
