/// What the server stands from those who do not behave.

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "studio/server/fake_session_for_tests.hpp"
#include "studio/server/raw_client_for_tests.hpp"
#include "studio/server/server.hpp"

namespace maggic::studio {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class HostileClientsTest : public ::testing::Test {
 protected:
  static ConnectionLimits limits() {
    return {.request = milliseconds(2000),
            .request_when_crowded = milliseconds(50),
            .write = milliseconds(1000)};
  }

  /// Everything that comes back for `text`.
  std::string answer_to(std::string_view text) {
    RawClient client(server_.port());
    client.send(text);
    return client.read_to_end();
  }
  std::string answer_to(std::string_view method, std::string_view target, std::string_view more) {
    RawClient client(server_.port());
    client.request(method, target, more);
    return client.read_to_end();
  }
  /// Whether it still answers as ever.
  bool serves() {
    const httplib::Result result = httplib::Client("127.0.0.1", server_.port()).Get("/api/state");
    return result && result->status == 200;
  }
  int gray_threshold() { return session_.colors()["gray_threshold"].get<int>(); }

  /// Pictures so large that no socket takes one whole.
  FakeSession session_{1 << 20};
  Server server_{session_, {.port = 0, .most_picture_streams = 3, .connection = limits()}};
};

TEST_F(HostileClientsTest, ForeignHostsAndOriginsAreTurnedAway) {
  EXPECT_THAT(answer_to("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
              AllOf(StartsWith("HTTP/1.1 403 "), Not(HasSubstr("doctype"))));
  EXPECT_THAT(answer_to("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to("GET", "/api/state", "Host: evil.example\r\n\r\n"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to("GET", "/api/state", "Origin: http://evil.example\r\n\r\n"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to("GET", "/api/state", "Sec-Fetch-Site: cross-site\r\n\r\n"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to("PUT", "/api/colors",
                        "Origin: null\r\nContent-Type: application/json\r\n"
                        "Content-Length: 21\r\n\r\n{\"gray_threshold\": 1}"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to("OPTIONS", "/api/colors",
                        "Origin: http://evil.example\r\n"
                        "Access-Control-Request-Method: PUT\r\n\r\n"),
              AllOf(StartsWith("HTTP/1.1 403 "), Not(HasSubstr("Access-Control"))));
  EXPECT_EQ(gray_threshold(), 60);
}

TEST_F(HostileClientsTest, ABodyIsNeverTakenForAnotherRequest) {
  const std::string port = std::to_string(server_.port());
  const std::string body = "{\"gray_threshold\": 1}";
  const std::string hidden =
      "PUT /api/colors HTTP/1.1\r\nHost: 127.0.0.1:" + port +
      "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
      "\r\n\r\n" + body;
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n\r\n";
  for (const std::string& head :
       {"Origin: http://evil.example\r\n" + length, "Content-Type: text/plain\r\n" + length, length,
        std::string("Content-Length: 0\r\n\r\n"), std::string("\r\n"),
        std::string("Transfer-Encoding: chunked\r\n\r\n")}) {
    for (const char* method : {"GET", "POST"}) {
      const std::string answer = answer_to(method, "/api/undo", head + hidden);
      EXPECT_THAT(answer, StartsWith("HTTP/1.1 4")) << method << ' ' << head;
      EXPECT_EQ(answer.find("HTTP/1.1", 1), answer.npos) << method << ' ' << head << answer;
      EXPECT_EQ(gray_threshold(), 60) << method << ' ' << head;
    }
  }
}

TEST_F(HostileClientsTest, AHugeBodyIsRefusedAndTheAnswerStillArrives) {
  const std::string body = "{\"a\": \"" + std::string(1 << 20, 'x') + "\"}";
  const httplib::Result result =
      httplib::Client("127.0.0.1", server_.port()).Put("/api/colors", body, "application/json");
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->status, 413);
  EXPECT_THAT(answer_to("PUT", "/api/colors",
                        "Content-Type: application/json\r\nContent-Length: 99999999999\r\n\r\n"),
              StartsWith("HTTP/1.1 413 "));
  EXPECT_TRUE(serves());
}

TEST_F(HostileClientsTest, WhatIsNotHttpIsRefused) {
  EXPECT_THAT(answer_to("nonsense\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answer_to(std::string("\0\xff\x16\x03\r\n\r\n", 8)), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answer_to("GET", "/" + std::string(10'000, 'a'), "\r\n"),
              StartsWith("HTTP/1.1 414 "));
  EXPECT_THAT(answer_to("GET", "/", "X: " + std::string(10'000, 'a') + "\r\n\r\n"),
              StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answer_to("GET", "/../../etc/passwd", "\r\n"), StartsWith("HTTP/1.1 404 "));
  EXPECT_THAT(answer_to("GET", "/api/../../../etc/passwd", "\r\n"), StartsWith("HTTP/1.1 404 "));
  EXPECT_TRUE(serves());
}

TEST_F(HostileClientsTest, AHeadWithoutEndIsNotReadToTheEnd) {
  RawClient client(server_.port());
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += "X: " + std::string(100, 'y') + "\r\n";
  client.request("GET", "/", "");
  int sent = 0;
  while (sent < 1000 && client.send(lines)) ++sent;
  EXPECT_LT(sent, 1000) << "a hundred megabytes of headers were taken";
  EXPECT_TRUE(serves());
}

TEST_F(HostileClientsTest, ACompressedBodyIsNotUnpacked) {
  EXPECT_THAT(answer_to("PUT", "/api/colors",
                        "Content-Type: application/json\r\nContent-Encoding: gzip\r\n"
                        "Content-Length: 3\r\n\r\nabc"),
              StartsWith("HTTP/1.1 415 "));
}

TEST_F(HostileClientsTest, ABodyThatNeverComesIsNotWaitedForForever) {
  EXPECT_EQ(answer_to("PUT", "/api/colors",
                      "Content-Type: application/json\r\nContent-Length: 100\r\n\r\n{")
                .find("HTTP/1.1 200"),
            std::string::npos);
  EXPECT_EQ(gray_threshold(), 60);
}

TEST_F(HostileClientsTest, PartsOfAnAnswerAreNotMultiplied) {
  std::string ranges = "Range: bytes=0-";
  for (int i = 0; i < 500; ++i) ranges += ",0-";
  const std::string answer = answer_to("GET", "/", ranges + "\r\n\r\n");
  EXPECT_LT(answer.size(), 100'000u);
  EXPECT_THAT(answer_to("GET", "/api/stream/never.mjpg", "Range: bytes=5-1\r\n\r\n"),
              StartsWith("HTTP/1.1 416 "));
  EXPECT_TRUE(serves());
}

TEST_F(HostileClientsTest, AReaderThatNeverReadsHoldsUpNobodyAndIsDropped) {
  RawClient lazy(server_.port(), 4096);
  lazy.request("GET", "/api/stream/overlay.mjpg");
  RawClient eager(server_.port());
  eager.request("GET", "/api/stream/overlay.mjpg");
  for (int i = 0; i < 3; ++i) {
    // Not told by a matcher, which would print the picture.
    EXPECT_TRUE(eager.read_until("--frame\r\n").ends_with("--frame\r\n"));
    EXPECT_TRUE(serves());
  }
  const auto until = steady_clock::now() + std::chrono::seconds(10);
  std::string open = "2";
  while (open != "1" && steady_clock::now() < until) {
    const httplib::Result result = httplib::Client("127.0.0.1", server_.port()).Get("/api/state");
    ASSERT_TRUE(result);
    open = nlohmann::json::parse(result->body)["streams"]["open"].dump();
    eager.read_until("--frame\r\n");
  }
  EXPECT_EQ(open, "1") << "the one that reads";
}

TEST_F(HostileClientsTest, StoppingDoesNotWaitForReadersThatNeverRead) {
  FakeSession session(1 << 20);
  Server server(session, {.port = 0});  // With the ordinary, long patience.
  std::vector<RawClient> lazy;
  for (int i = 0; i < 8; ++i) {
    lazy.emplace_back(server.port(), 4096);
    lazy.back().request("GET", "/api/stream/overlay.mjpg");
    lazy.back().read_until("\r\n\r\n");
  }
  RawClient silent(server.port());
  RawClient half(server.port());
  half.send("GET / HT");
  const auto began = steady_clock::now();
  server.stop();
  EXPECT_LT(steady_clock::now() - began, milliseconds(4000)) << "their patience is longer";
}

TEST_F(HostileClientsTest, HundredsWhoSayNothingAreClosedForThoseWhoDo) {
  std::vector<RawClient> silent;
  for (int i = 0; i < 300; ++i) {
    silent.emplace_back(server_.port());
    ASSERT_TRUE(silent.back().connected()) << i;
  }
  EXPECT_TRUE(serves());
}

TEST_F(HostileClientsTest, HundredsAtOnceAreAllServed) {
  std::vector<RawClient> clients;
  for (int i = 0; i < 300; ++i) {
    clients.emplace_back(server_.port());
    ASSERT_TRUE(clients.back().request("GET", "/api/state")) << i;
  }
  int served = 0;
  for (RawClient& client : clients) {
    served += client.read_to_end().starts_with("HTTP/1.1 200 ") ? 1 : 0;
  }
  EXPECT_EQ(served, 300);
}

TEST_F(HostileClientsTest, ManyThreadsAskingAtOnceAreAllServed) {
  std::vector<std::thread> threads;
  std::atomic<int> served{0};
  for (int i = 0; i < 16; ++i) {
    threads.emplace_back([this, &served] {
      for (int k = 0; k < 20; ++k) served += serves() ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(served, 16 * 20);
}

}  // namespace
}  // namespace maggic::studio
