#include "scan/band_workers.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace maggic {
namespace {

TEST(BandWorkers, DoEveryBandOnceARound) {
  for (const std::size_t bands : {1U, 2U, 5U}) {
    BandWorkers workers(bands);
    EXPECT_EQ(workers.bands(), bands);
    std::vector<int> done(bands, 0);  // Each band writes its own place.
    auto work = [&](std::size_t band) { ++done[band]; };
    for (int round = 0; round < 200; ++round) workers.run(work);
    EXPECT_TRUE(std::ranges::all_of(done, [](int times) { return times == 200; }));
  }
}

TEST(BandWorkers, DoTheFirstBandOnTheCallersThread) {
  BandWorkers workers(2);
  std::vector<std::thread::id> threads(2);
  auto work = [&](std::size_t band) { threads[band] = std::this_thread::get_id(); };
  workers.run(work);
  EXPECT_EQ(threads[0], std::this_thread::get_id());
  EXPECT_NE(threads[1], std::this_thread::get_id());
}

TEST(BandWorkers, PassOnWhatTheLowestBandThrewAndGoOn) {
  BandWorkers workers(3);
  std::atomic<int> calls{0};
  bool fail = true;
  auto work = [&](std::size_t band) {
    ++calls;
    if (fail && band > 0) throw std::runtime_error("band " + std::to_string(band));
  };
  try {
    workers.run(work);
    FAIL() << "expected an exception";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "band 1");
  }
  fail = false;
  workers.run(work);
  EXPECT_EQ(calls, 6);
}

}  // namespace
}  // namespace maggic
