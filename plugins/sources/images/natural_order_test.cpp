#include "natural_order.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace maggic::images {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::ranges::sort(names, comes_naturally_before);
  return names;
}

/// Few different characters, so that names share beginnings and numbers collide.
rc::Gen<std::string> names() {
  return rc::gen::container<std::string>(rc::gen::element('0', '1', '2', '9', 'a', '.', '\xC3'));
}

TEST(NaturalOrder, NumbersCountByTheirValue) {
  EXPECT_THAT(sorted({"img10.png", "img9.png", "img1.png", "img2.png"}),
              ElementsAre("img1.png", "img2.png", "img9.png", "img10.png"));
  EXPECT_THAT(sorted({"2024-1-10", "2024-1-9", "2023-12-31"}),
              ElementsAre("2023-12-31", "2024-1-9", "2024-1-10"));
}

TEST(NaturalOrder, NumbersMayBeLongerThanAnyInteger) {
  EXPECT_THAT(sorted({"100000000000000000000001", "99999999999999999999999", "a"}),
              ElementsAre("99999999999999999999999", "100000000000000000000001", "a"));
}

TEST(NaturalOrder, LeadingZerosDecideLast) {
  EXPECT_THAT(sorted({"f01", "f2", "f1", "f001"}), ElementsAre("f1", "f01", "f001", "f2"));
}

RC_GTEST_PROP(NaturalOrder, IsAStrictTotalOrder, ()) {
  const std::string a = *names();
  const std::string b = *names();
  const std::string c = *names();
  RC_ASSERT(!comes_naturally_before(a, a));
  RC_ASSERT(a == b || comes_naturally_before(a, b) != comes_naturally_before(b, a));
  if (comes_naturally_before(a, b) && comes_naturally_before(b, c)) {
    RC_ASSERT(comes_naturally_before(a, c));
  }
}

}  // namespace
}  // namespace maggic::images
