/// Pictures and events as they come.

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "studio/server/event_stream.hpp"
#include "studio/server/fake_session_for_tests.hpp"
#include "studio/server/raw_client_for_tests.hpp"
#include "studio/server/server.hpp"

namespace maggic::studio {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class StreamsTest : public ::testing::Test {
 protected:
  json state() {
    const httplib::Result result = httplib::Client("127.0.0.1", server_.port()).Get("/api/state");
    return result ? json::parse(result->body) : json();
  }
  /// Waits until that many picture streams are open; false when it takes too long.
  bool streams_become(int open) {
    const auto until = steady_clock::now() + std::chrono::seconds(10);
    while (state()["streams"]["open"] != open) {
      if (steady_clock::now() > until) return false;
      std::this_thread::yield();
    }
    return true;
  }

  FakeSession session_;
  Server server_{session_, {.port = 0, .most_picture_streams = 2, .most_event_streams = 8}};
};

TEST_F(StreamsTest, PicturesComeAsPartsEachEndedAtOnce) {
  RawClient client(server_.port());
  client.request("GET", "/api/stream/overlay.mjpg?width=65");
  const std::string head = client.read_until("\r\n\r\n");
  EXPECT_THAT(head, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(head, HasSubstr("Content-Type: multipart/x-mixed-replace; boundary=frame\r\n"));
  const std::string part = "Content-Type: image/jpeg\r\nContent-Length: 1000\r\n\r\n" +
                           std::string(1000, 'A') + "\r\n--frame\r\n";
  EXPECT_EQ(client.read_until("--frame\r\n"), "--frame\r\n");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(client.read_until("--frame\r\n"), part);
}

TEST_F(StreamsTest, PicturesComeThirtyTimesASecondAtMost) {
  RawClient client(server_.port());
  client.request("GET", "/api/stream/overlay.mjpg");
  for (int i = 0; i < 2; ++i) client.read_until("--frame\r\n");
  const auto began = steady_clock::now();
  for (int i = 0; i < 15; ++i) client.read_until("--frame\r\n");
  // The session has a hundred a second.
  EXPECT_GT(steady_clock::now() - began, milliseconds(15 * 33 - 40));
}

TEST_F(StreamsTest, NoPictureIsMadeWhenNobodyWatches) {
  {
    RawClient client(server_.port());
    client.request("GET", "/api/stream/overlay.mjpg");
    client.read_until("image/jpeg");
  }
  ASSERT_TRUE(streams_become(0));
  const int given = session_.pictures_given();
  state();
  EXPECT_EQ(session_.pictures_given(), given);
}

TEST_F(StreamsTest, MoreThanMayBeOpenAreRefusedUntilOneEnds) {
  std::vector<RawClient> watching;
  for (int i = 0; i < 2; ++i) {
    watching.emplace_back(server_.port());
    watching.back().request("GET", "/api/stream/overlay.mjpg");
    watching.back().read_until("image/jpeg");
  }
  EXPECT_EQ(state()["streams"], (json{{"open", 2}, {"max", 2}}));
  RawClient refused(server_.port());
  refused.request("GET", "/api/stream/labels.mjpg");
  EXPECT_THAT(refused.read_to_end(), StartsWith("HTTP/1.1 503 "));

  watching.pop_back();
  ASSERT_TRUE(streams_become(1));
  RawClient next(server_.port());
  next.request("GET", "/api/stream/labels.mjpg");
  EXPECT_THAT(next.read_until("\r\n"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(StreamsTest, EventsComeWithTheirNumbers) {
  session_.happen("settings", R"({"revision":1})");
  RawClient client(server_.port());
  client.request("GET", "/api/events");
  EXPECT_THAT(client.read_until("\r\n\r\n"), HasSubstr("Content-Type: text/event-stream\r\n"));
  EXPECT_EQ(client.read_until("\n\n"), "retry: 1000\n\n");
  EXPECT_EQ(client.read_until("\n\n"), "id: 1\nevent: settings\ndata: {\"revision\":1}\n\n");
  session_.happen("message", R"({"level":"note"})");
  EXPECT_EQ(client.read_until("\n\n"), "id: 2\nevent: message\ndata: {\"level\":\"note\"}\n\n");
}

TEST_F(StreamsTest, ABrowserThatWasCutOffGoesOnWhereItWas) {
  for (int i = 1; i <= 3; ++i) session_.happen("frame", std::to_string(i));
  const auto first_event = [&](const char* header) {
    RawClient client(server_.port());
    client.request("GET", "/api/events", header);
    client.read_until("retry: 1000\n\n");
    return client.read_until("\n\n");
  };
  EXPECT_EQ(first_event("Last-Event-ID: 1\r\n\r\n"), "id: 2\nevent: frame\ndata: 2\n\n");
  for (const char* of_nobody : {"Last-Event-ID: 70\r\n\r\n", "Last-Event-ID: -1\r\n\r\n",
                                "Last-Event-ID: x\r\n\r\n", "\r\n"}) {
    EXPECT_EQ(first_event(of_nobody), "id: 3\nevent: frame\ndata: 3\n\n") << of_nobody;
  }
}

TEST_F(StreamsTest, MoreEventStreamsThanMayBeOpenAreRefused) {
  std::vector<RawClient> listening;
  for (int i = 0; i < 8; ++i) {
    listening.emplace_back(server_.port());
    listening.back().request("GET", "/api/events");
    listening.back().read_until("retry");
  }
  RawClient refused(server_.port());
  refused.request("GET", "/api/events");
  EXPECT_THAT(refused.read_to_end(), StartsWith("HTTP/1.1 503 "));
}

TEST_F(StreamsTest, StoppingEndsOpenStreamsAtOnce) {
  RawClient picture(server_.port());
  picture.request("GET", "/api/picture/never.jpg");
  RawClient pictures(server_.port());
  pictures.request("GET", "/api/stream/overlay.mjpg");
  pictures.read_until("image/jpeg");
  RawClient never(server_.port());
  never.request("GET", "/api/stream/never.mjpg");
  never.read_until("\r\n\r\n");
  RawClient events(server_.port());
  events.request("GET", "/api/events");
  events.read_until("retry");

  const auto began = steady_clock::now();
  server_.stop();
  EXPECT_LT(steady_clock::now() - began, milliseconds(4000)) << "some would wait for longer";
  for (RawClient* client : {&picture, &pictures, &never, &events}) {
    client->read_to_end();
    EXPECT_TRUE(client->closed());
  }
}

TEST(WireTextTest, LinesOfDataAreToldEach) {
  EXPECT_EQ(wire_text({7, "message", "one\ntwo"}),
            "id: 7\nevent: message\ndata: one\ndata: two\n\n");
  EXPECT_EQ(wire_text({8, "message", ""}), "id: 8\nevent: message\ndata: \n\n");
}

}  // namespace
}  // namespace maggic::studio
