/// Tracking asks for no memory once it has seen as much as there is to see.

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "testing/allocation_counter.hpp"
#include "tracking/crowd_for_tests.hpp"

namespace maggic::tracking {
namespace {

using testing::AllocationCounter;

enum class Pattern { kTwoTag, kThreeTag, kDiagonal };

struct Case {
  const char* name;
  Pattern pattern;
  int robots;
  int strays;
  bool heaped;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

TagLayout layout_of(Pattern pattern) {
  switch (pattern) {
    case Pattern::kTwoTag: return two_tags();
    case Pattern::kThreeTag: return three_tags();
    case Pattern::kDiagonal: return diagonal_squares();
  }
  return {};
}

class TrackingAllocationTest : public ::testing::TestWithParam<Case> {};

TEST_P(TrackingAllocationTest, IsNoneAfterWarmUp) {
  if (!AllocationCounter::works()) GTEST_SKIP() << "the sanitizer has operator new for itself";
  const Case& c = GetParam();
  const std::vector<Scene> scenes = scenes_of({.layout = layout_of(c.pattern),
                                               .robots = c.robots,
                                               .strays = c.strays,
                                               .heaped = c.heaped,
                                               .moving = true});
  TrackingEngine engine(standard_parameters(), {layout_of(c.pattern)});
  Detections out;
  std::uint64_t frame = 0;
  const auto track_once_round = [&] {
    std::size_t robots = 0;
    for (const Scene& scene : scenes) {
      const auto captured = std::chrono::milliseconds(16) * frame;
      engine.track({frame++, captured, scene.blobs(), scene.field()}, out);
      robots += out.robots.size();
    }
    return robots;
  };
  const AllocationCounter cold;
  track_once_round();
  EXPECT_GT(cold.count_of_this_thread(), 0u);
  track_once_round();
  const AllocationCounter warm;
  const std::size_t robots = track_once_round();
  EXPECT_EQ(warm.count_of_this_thread(), 0u);
  EXPECT_GT(robots, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    , TrackingAllocationTest,
    ::testing::Values(Case{"FewRobots", Pattern::kThreeTag, 6, 0, false},
                      Case{"TwoTeamsAmongStrays", Pattern::kTwoTag, 22, 300, false},
                      Case{"ThreeTagsAmongHeapsOfStrays", Pattern::kThreeTag, 22, 300, true},
                      Case{"NoiseAllOver", Pattern::kDiagonal, 22, 2500, true}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace maggic::tracking
