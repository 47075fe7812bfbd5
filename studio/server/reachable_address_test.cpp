/// What to type.

#include "studio/server/reachable_address.hpp"

#include <arpa/inet.h>

#include <gtest/gtest.h>

namespace maggic::studio {
namespace {

TEST(ReachableAddressTest, OneAddressIsItself) {
  for (const char* address : {"127.0.0.1", "192.168.1.5", "::1", "pit"}) {
    EXPECT_EQ(reachable_address(address), address);
  }
}

TEST(ReachableAddressTest, AllAddressesAreToldByOneThatCanBeTyped) {
  for (const char* address : {"0.0.0.0", "::"}) {
    const std::string one = reachable_address(address);
    in_addr parsed{};
    EXPECT_EQ(::inet_pton(AF_INET, one.c_str(), &parsed), 1) << one;
    EXPECT_NE(parsed.s_addr, INADDR_ANY) << one;
  }
}

}  // namespace
}  // namespace maggic::studio
