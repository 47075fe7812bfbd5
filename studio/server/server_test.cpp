/// What the server answers to a browser that behaves.

#include "studio/server/server.hpp"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "studio/server/fake_session_for_tests.hpp"

namespace maggic::studio {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ServerTest : public ::testing::Test {
 protected:
  httplib::Client client() const { return httplib::Client("127.0.0.1", server_.port()); }
  json get(const std::string& path, int status = 200) const {
    const httplib::Result result = client().Get(path);
    return checked(result, path, status);
  }
  json post(const std::string& path, const std::string& body, int status = 200) const {
    const httplib::Result result = client().Post(path, body, "application/json");
    return checked(result, path, status);
  }
  json put_colors(const std::string& body, int status = 200) const {
    const httplib::Result result = client().Put("/api/colors", body, "application/json");
    return checked(result, "/api/colors", status);
  }

  FakeSession session_;
  Server server_{session_, {.port = 0}};

 private:
  static json checked(const httplib::Result& result, const std::string& path, int status) {
    if (!result) {
      ADD_FAILURE() << path << ": " << to_string(result.error());
      return {};
    }
    EXPECT_EQ(result->status, status) << path << ": " << result->body;
    EXPECT_EQ(result->get_header_value("Content-Type"), "application/json") << path;
    EXPECT_EQ(result->get_header_value("Cache-Control"), "no-store") << path;
    return json::parse(result->body, nullptr, false);
  }
};

TEST_F(ServerTest, TellsWhereItIs) {
  EXPECT_GT(server_.port(), 0);
  EXPECT_EQ(server_.url(), "http://127.0.0.1:" + std::to_string(server_.port()) + "/");
  EXPECT_EQ(server_.token(), "");
}

TEST_F(ServerTest, GivesThePageWithWhatKeepsForeignScriptsOut) {
  const httplib::Result page = client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, StartsWith("<!doctype html>"));
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"),
              AllOf(StartsWith("default-src 'self'; img-src 'self' data: blob:"),
                    HasSubstr("frame-ancestors 'none'")));
  EXPECT_EQ(page->get_header_value("Cache-Control"), "no-cache");
  EXPECT_FALSE(page->has_header("Access-Control-Allow-Origin"));
}

TEST_F(ServerTest, GivesThePageOnce) {
  const httplib::Result page = client().Get("/");
  ASSERT_TRUE(page);
  const httplib::Result again =
      client().Get("/", {{"If-None-Match", page->get_header_value("ETag")}});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->status, 304);
  EXPECT_EQ(again->body, "");
}

TEST_F(ServerTest, AnswersHeadAsGetWithoutABody) {
  const httplib::Result page = client().Get("/");
  const httplib::Result head = client().Head("/");
  ASSERT_TRUE(page && head);
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->body, "");
  EXPECT_EQ(head->get_header_value("Content-Length"), std::to_string(page->body.size()));
  EXPECT_EQ(client().Head("/api/stream/overlay.mjpg")->status, 200);
  EXPECT_EQ(get("/api/state")["streams"]["open"], 0);
}

TEST_F(ServerTest, TellsTheStateAndTheStreams) {
  const json state = get("/api/state");
  EXPECT_EQ(state["pipeline"], "fake");
  EXPECT_EQ(state["streams"], (json{{"open", 0}, {"max", 8}}));
}

TEST_F(ServerTest, PausesAndSteps) {
  EXPECT_EQ(post("/api/pause", R"({"paused": true})")["running"], false);
  EXPECT_EQ(post("/api/step", "")["running"], false);
  EXPECT_EQ(session_.stepped(), 1);
  EXPECT_EQ(post("/api/pause", R"({"paused": false})")["running"], true);
}

TEST_F(ServerTest, ChangesColorsAndTakesThemBack) {
  EXPECT_EQ(get("/api/colors")["gray_threshold"], 60);
  EXPECT_EQ(put_colors(R"({"gray_threshold": 40})")["gray_threshold"], 40);
  EXPECT_EQ(get("/api/colors")["gray_threshold"], 40);
  EXPECT_EQ(post("/api/undo", "")["gray_threshold"], 60);
}

TEST_F(ServerTest, PassesOnWhatTheSessionRefuses) {
  const json mistakes = put_colors(R"({"gray_threshold": 300})", 422);
  EXPECT_EQ(mistakes["mistakes"][0]["key"], "segmenter.gray_threshold");
  EXPECT_EQ(post("/api/undo", "", 409)["error"], "there is nothing to undo");
}

TEST_F(ServerTest, SaysSoWhenTheSessionFails) {
  EXPECT_EQ(get("/api/density", 500)["error"], "the fake has no frames");
}

TEST_F(ServerTest, ABodyThatIsNoJsonObjectIsRefused) {
  for (const char* body : {"{", "nonsense", "{\"gray_threshold\": 1}x", "\xff", "{'a': 1}"}) {
    EXPECT_THAT(put_colors(body, 400)["error"].get<std::string>(),
                StartsWith("the body is not JSON"))
        << body;
  }
  for (const char* body : {"[]", "1", "null", "\"text\""}) {
    EXPECT_THAT(put_colors(body, 400)["error"].get<std::string>(), HasSubstr("expected an object"))
        << body;
  }
  const std::string deep = "{\"a\":" + std::string(50'000, '[') + std::string(50'000, ']') + "}";
  EXPECT_THAT(put_colors(deep, 400)["error"].get<std::string>(), HasSubstr("nested"));
  EXPECT_EQ(get("/api/colors")["gray_threshold"], 60);
}

TEST_F(ServerTest, ExplainsAPixelNamedByTwoWholeNumbers) {
  EXPECT_EQ(get("/api/explain?x=312&y=240"), (json{{"x", 312}, {"y", 240}}));
  for (const char* query :
       {"", "?x=1", "?x=1&y=", "?x=1&y=b", "?x=1.5&y=2", "?x=1&x=2&y=3", "?x=99999999999&y=1"}) {
    EXPECT_TRUE(get(std::string("/api/explain") + query, 400).contains("error")) << query;
  }
}

TEST_F(ServerTest, BytesThatAreNoTextDoNotBreakAnAnswer) {
  EXPECT_EQ(get("/api/plane")["labels"], "\xef\xbf\xbd not UTF-8");
}

TEST_F(ServerTest, GivesOnePicture) {
  const httplib::Result picture = client().Get("/api/picture/overlay.jpg?width=64");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->status, 200);
  EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(picture->body, std::string(1000, '\x40'));
}

TEST_F(ServerTest, AViewOrWidthThereIsNotIsToldOf) {
  EXPECT_EQ(get("/api/picture/nothing.jpg", 404)["error"],
            "there is no view 'nothing' (known: overlay, labels, never)");
  EXPECT_TRUE(get("/api/stream/nothing.mjpg", 404).contains("error"));
  for (const char* width : {"0", "-5", "15", "9000", "wide", ""}) {
    EXPECT_TRUE(get(std::string("/api/picture/overlay.jpg?width=") + width, 400).contains("error"))
        << width;
  }
}

TEST_F(ServerTest, SaysSoWhenNoPictureComes) {
  EXPECT_THAT(get("/api/picture/never.jpg", 503)["error"].get<std::string>(),
              HasSubstr("no picture"));
}

TEST_F(ServerTest, OtherPathsAreNotFound) {
  for (const char* path :
       {"/api", "/api/", "/api/nothing", "/nothing.html", "/../../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "/./index.html", "//index.html",
        "/index.html/", "/index.html%00.css", "/studio/page/index.html"}) {
    EXPECT_TRUE(get(path, 404).contains("error")) << path;
  }
}

TEST_F(ServerTest, OtherMethodsAreToldWhichAreTaken) {
  const httplib::Result result = client().Delete("/api/colors");
  ASSERT_TRUE(result);
  EXPECT_EQ(result->status, 405);
  EXPECT_EQ(result->get_header_value("Allow"), "GET, HEAD, PUT");
  EXPECT_TRUE(get("/api/undo", 405).contains("error"));
  EXPECT_TRUE(post("/api/state", "", 405).contains("error"));
  EXPECT_TRUE(post("/", "", 405).contains("error"));
}

TEST_F(ServerTest, APortInUseIsNamed) {
  try {
    const Server second(session_, {.port = server_.port()});
    FAIL() << "two servers on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "port " + std::to_string(server_.port()) +
                                " of 127.0.0.1 cannot be used: Address already in use");
  }
}

TEST_F(ServerTest, AnAddressOfNobodyIsNamed) {
  try {
    const Server nowhere(session_, {.listen = "no such address", .port = 0});
    FAIL() << "a server nowhere";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), StartsWith("port 0 of no such address cannot be used: "));
  }
}

TEST_F(ServerTest, ItsPortIsFreeOnceItHasStopped) {
  const int port = server_.port();
  EXPECT_TRUE(client().Get("/"));
  server_.stop();
  EXPECT_FALSE(client().Get("/"));
  const Server next(session_, {.port = port});
  EXPECT_TRUE(client().Get("/"));
}

TEST(OpenServerTest, OffersItselfToOthersWithATokenOnly) {
  FakeSession session;
  const Server server(session, {.listen = "0.0.0.0", .port = 0});
  ASSERT_EQ(server.token().size(), 32u);
  EXPECT_THAT(server.url(), ::testing::EndsWith("/?token=" + server.token()));

  httplib::Client client("127.0.0.1", server.port());
  const httplib::Result none = client.Get("/");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->status, 401);
  EXPECT_FALSE(none->has_header("Set-Cookie"));
  EXPECT_EQ(client.Get("/api/state")->status, 401);
  EXPECT_EQ(client.Get("/api/state?token=wrong")->status, 401);
  EXPECT_EQ(client.Put("/api/colors", "{}", "application/json")->status, 401);

  const httplib::Result page = client.Get("/?token=" + server.token());
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  const std::string cookie = page->get_header_value("Set-Cookie");
  EXPECT_THAT(cookie, AllOf(HasSubstr("HttpOnly"), HasSubstr("SameSite=Strict")));
  EXPECT_EQ(client.Get("/api/state", {{"Cookie", cookie.substr(0, cookie.find(';'))}})->status,
            200);
  EXPECT_EQ(client.Get("/api/state", {{"Authorization", "Bearer " + server.token()}})->status, 200);
}

TEST(OpenServerTest, TheAddressItTellsWorks) {
  FakeSession session;
  const Server server(session, {.listen = "0.0.0.0", .port = 0});
  const std::string url = server.url();
  const auto path = url.find("/?");
  const httplib::Result page = httplib::Client(url.substr(0, path)).Get(url.substr(path));
  ASSERT_TRUE(page) << url;
  EXPECT_EQ(page->status, 200) << url;
}

TEST(OpenServerTest, AnAddressOfColonsIsToldInBrackets) {
  FakeSession session;
  try {
    const Server server(session, {.listen = "::1", .port = 0});
    EXPECT_EQ(server.url(), "http://[::1]:" + std::to_string(server.port()) + "/");
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "no IPv6 here: " << error.what();
  }
}

}  // namespace
}  // namespace maggic::studio
