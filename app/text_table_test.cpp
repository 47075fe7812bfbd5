#include "app/text_table.hpp"

#include <gtest/gtest.h>

namespace maggic::app {
namespace {

TEST(Shortened, LeavesWhatFits) {
  EXPECT_EQ(shortened("", 5), "");
  EXPECT_EQ(shortened("hello", 5), "hello");
  EXPECT_EQ(shortened("größe", 5), "größe");
}

TEST(Shortened, EndsInAnEllipsisWithinTheColumns) {
  EXPECT_EQ(shortened("hello you", 5), "hell…");
  EXPECT_EQ(shortened("größer als", 5), "größ…");
  EXPECT_EQ(shortened("hello", 1), "…");
}

TEST(Shortened, CutsAListBetweenItsItems) {
  EXPECT_EQ(shortened("[10, 20, 30, 40]", 12), "[10, 20, …");
  EXPECT_EQ(shortened("[orange, yellow]", 6), "[oran…") << "not one item fits";
}

}  // namespace
}  // namespace maggic::app
