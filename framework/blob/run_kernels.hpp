#pragma once
/// The inner loops that go over every run of a frame. Compiled once for every vector instruction
/// set and chosen when the program runs.

#include <cstddef>
#include <span>

#include "maggic/blob.hpp"

namespace maggic {

/// How many of `runs` have at least `shortest_px` pixels. @param shortest_px 1 … 65536.
std::size_t count_reaching(std::span<const Run> runs, int shortest_px);

/// So many runs behind those it keeps `copy_reaching` may overwrite.
inline constexpr std::size_t kCopyOverhang = 32;

/// Copies the runs of at least `shortest_px` pixels, in their order, to `kept`: the first of
/// `runs`, or room of its own for all of them and kCopyOverhang more.
/// @param shortest_px 1 … 65536.
/// @return how many.
std::size_t copy_reaching(std::span<const Run> runs, int shortest_px, Run* kept);

}  // namespace maggic
