/// The page inside of the program.

#include "studio/server/page_files.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace maggic::studio {
namespace {

const PageFile& index_page() {
  return *std::ranges::find(page_files(), std::string_view("index.html"), &PageFile::path);
}

TEST(PageFilesTest, HoldTheFirstPageWhole) {
  ASSERT_NE(std::ranges::find(page_files(), std::string_view("index.html"), &PageFile::path),
            page_files().end());
  EXPECT_TRUE(index_page().content.starts_with("<!doctype html>"));
  EXPECT_TRUE(index_page().content.ends_with("</html>\n"));
}

TEST(PageFilesTest, AllAreOfATypeThatBrowsersAreTold) {
  for (const PageFile& file : page_files()) EXPECT_NE(mime_type(file.path), "") << file.path;
}

TEST(PageFilesTest, AnUnknownEndingHasNoType) {
  EXPECT_EQ(mime_type("notes.txt~"), "");
  EXPECT_EQ(mime_type(""), "");
}

class PageRoutesTest : public ::testing::Test {
 protected:
  PageRoutesTest() { add_page_routes(routes_); }

  httplib::Response get(const char* path, const char* known_tag = "") const {
    httplib::Request request;
    if (*known_tag != '\0') request.set_header("If-None-Match", known_tag);
    httplib::Response response;
    const Routes::Match match = routes_.find("GET", path);
    if (match.handler != nullptr) (*match.handler)(request, match.name, response);
    return response;
  }
  Routes routes_;
};

TEST_F(PageRoutesTest, GiveEveryFileAsItIs) {
  for (const PageFile& file : page_files()) {
    const httplib::Response response = get(("/" + std::string(file.path)).c_str());
    EXPECT_EQ(response.status, 200) << file.path;
    EXPECT_EQ(response.body, file.content) << file.path;
    EXPECT_EQ(response.get_header_value("Content-Type"), mime_type(file.path)) << file.path;
  }
}

TEST_F(PageRoutesTest, TheFirstPageNeedsNoName) { EXPECT_EQ(get("/").body, index_page().content); }

TEST_F(PageRoutesTest, SendNothingToABrowserThatHasItAlready) {
  const std::string tag = get("/").get_header_value("ETag");
  EXPECT_EQ(tag.size(), 34u) << tag;
  for (const std::string& known : {tag, "W/" + tag, "\"other\", " + tag, std::string("*")}) {
    const httplib::Response again = get("/", known.c_str());
    EXPECT_EQ(again.status, 304) << known;
    EXPECT_EQ(again.body, "") << known;
    EXPECT_EQ(again.get_header_value("ETag"), tag) << known;
  }
  EXPECT_EQ(get("/", "\"other\"").status, 200);
}

}  // namespace
}  // namespace maggic::studio
