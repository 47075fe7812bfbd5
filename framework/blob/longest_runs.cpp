#include "maggic/longest_runs.hpp"

#include <algorithm>

#include "blob/run_kernels.hpp"

namespace maggic {
namespace {

constexpr int kBeyondAnyRun_px = 65536;

// The smallest length above `too_short_px` that at most `most` of `runs` reach. In growing steps,
// then by halving: it is mostly the next one.
int length_few_reach(std::span<const Run> runs, int too_short_px, std::size_t most) {
  int step_px = 1;
  int enough_px = too_short_px + 1;
  while (count_reaching(runs, enough_px) > most) {
    too_short_px = enough_px;
    step_px *= 2;
    enough_px = std::min(too_short_px + step_px, kBeyondAnyRun_px);
  }
  while (enough_px - too_short_px > 1) {
    const int middle_px = (too_short_px + enough_px) / 2;
    (count_reaching(runs, middle_px) > most ? too_short_px : enough_px) = middle_px;
  }
  return enough_px;
}

}  // namespace

std::span<const Run> LongestRuns::keep(std::span<const Run> runs, std::size_t most) {
  shortest_px_ = 1;
  if (runs.size() <= most) return runs;
  // What too many runs of a part reach, too many of the whole reach; so the length may grow on the
  // way. With room for twice as many each growth frees half of it, and they stay few.
  const std::size_t room = std::min(2 * most, runs.size());
  if (kept_.size() < room + kCopyOverhang) kept_.resize(room + kCopyOverhang);
  std::size_t count = 0;
  const auto shorten = [&] {
    const std::span<const Run> kept(kept_.data(), count);
    shortest_px_ = length_few_reach(kept, shortest_px_, most);
    count = copy_reaching(kept, shortest_px_, kept_.data());
  };
  while (!runs.empty()) {
    const std::span<const Run> next = runs.first(std::min(runs.size(), room - count));
    runs = runs.subspan(next.size());
    count += copy_reaching(next, shortest_px_, kept_.data() + count);
    const bool nearly_full = room - count <= room / 8;
    if (count > most && nearly_full) shorten();
  }
  if (count > most) shorten();
  return {kept_.data(), count};
}

}  // namespace maggic
