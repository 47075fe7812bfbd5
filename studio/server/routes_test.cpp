/// Which path leads where.

#include "studio/server/routes.hpp"

#include <gtest/gtest.h>

namespace maggic::studio {
namespace {

class RoutesTest : public ::testing::Test {
 protected:
  RoutesTest() {
    const Routes::Handler nothing = [](const httplib::Request&, std::string_view,
                                       httplib::Response&) {};
    routes_.add("GET", "/api/colors", nothing);
    routes_.add("PUT", "/api/colors", nothing);
    routes_.add("GET", "/api/stream/*.mjpg", nothing);
  }
  Routes routes_;
};

TEST_F(RoutesTest, HeadIsAnsweredAsGet) {
  EXPECT_NE(routes_.find("HEAD", "/api/colors").handler, nullptr);
}

TEST_F(RoutesTest, TellsWhichMethodsAPathTakes) {
  const Routes::Match match = routes_.find("DELETE", "/api/colors");
  EXPECT_TRUE(match.known);
  EXPECT_EQ(match.handler, nullptr);
  EXPECT_EQ(match.methods, "GET, HEAD, PUT");
}

TEST_F(RoutesTest, AStarStandsForOneName) {
  const Routes::Match match = routes_.find("GET", "/api/stream/overlay.mjpg");
  ASSERT_NE(match.handler, nullptr);
  EXPECT_EQ(match.name, "overlay");
  for (const char* path : {"/api/stream/.mjpg", "/api/stream/a/b.mjpg", "/api/stream/../x.mjpg",
                           "/api/stream/overlay", "/api/stream/overlay.jpg", "/api/stream.mjpg"}) {
    EXPECT_FALSE(routes_.find("GET", path).known) << path;
  }
}

TEST_F(RoutesTest, OtherPathsLeadNowhere) {
  for (const char* path :
       {"", "/", "/api", "/api/", "/api/colors/", "//api/colors", "/API/colors"}) {
    EXPECT_FALSE(routes_.find("GET", path).known) << path;
  }
}

}  // namespace
}  // namespace maggic::studio
