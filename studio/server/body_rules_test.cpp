/// Which bodies are read.

#include "studio/server/body_rules.hpp"

#include <gtest/gtest.h>

namespace maggic::studio {
namespace {

httplib::Request head(const char* method, httplib::Headers headers) {
  httplib::Request request;
  request.method = method;
  request.headers = std::move(headers);
  return request;
}

int status_of(const httplib::Request& request) {
  const auto refusal = refuse_body(request);
  return refusal ? refusal->status : 0;
}

TEST(BodyRulesTest, JsonOfAToldLengthIsRead) {
  EXPECT_EQ(
      status_of(head("PUT", {{"Content-Length", "262144"}, {"Content-Type", "application/json"}})),
      0);
  EXPECT_EQ(status_of(head("POST", {{"Content-Length", "2"},
                                    {"Content-Type", "Application/JSON; charset=utf-8"}})),
            0);
}

TEST(BodyRulesTest, NoBodyNeedsNoHeaders) {
  EXPECT_EQ(status_of(head("POST", {})), 0);
  EXPECT_EQ(status_of(head("POST", {{"Content-Length", "0"}})), 0);
  EXPECT_EQ(status_of(head("GET", {})), 0);
}

TEST(BodyRulesTest, WhatIsTooLongIsRefusedBeforeItIsSent) {
  const auto of_length = [](const char* length) {
    return status_of(
        head("PUT", {{"Content-Length", length}, {"Content-Type", "application/json"}}));
  };
  EXPECT_EQ(of_length("262145"), 413);
  EXPECT_EQ(of_length("99999999999999999999999999"), 413);
  for (const char* length : {"", "-1", "+1", "1e3", "0x10", " 1", "1 ", "1,1"}) {
    EXPECT_EQ(of_length(length), 400) << length;
  }
}

TEST(BodyRulesTest, WhatCouldHideAnotherRequestIsRefused) {
  EXPECT_EQ(status_of(head("POST", {{"Transfer-Encoding", "chunked"}})), 411);
  EXPECT_EQ(status_of(head("POST", {{"Content-Length", "0"}, {"Content-Length", "5"}})), 400);
  EXPECT_EQ(status_of(head("GET", {{"Content-Length", "5"}})), 400);
}

TEST(BodyRulesTest, OnlyPlainJsonIsTaken) {
  EXPECT_EQ(status_of(head("PUT", {{"Content-Length", "5"}})), 415);
  for (const char* type : {"text/plain", "multipart/form-data; boundary=x", "application/jsonp",
                           "application/x-www-form-urlencoded", "application/json, text/plain"}) {
    EXPECT_EQ(status_of(head("PUT", {{"Content-Length", "5"}, {"Content-Type", type}})), 415)
        << type;
  }
  EXPECT_EQ(status_of(head("PUT", {{"Content-Length", "5"},
                                   {"Content-Type", "application/json"},
                                   {"Content-Encoding", "gzip"}})),
            415);
}

TEST(BodyRulesTest, AnnouncesWhatMayFollowWhateverIsWrongWithIt) {
  EXPECT_EQ(announced_bytes(head("GET", {})), 0u);
  EXPECT_EQ(announced_bytes(head("GET", {{"Content-Length", "7"}})), 7u);
  EXPECT_GT(announced_bytes(head("PUT", {{"Content-Length", "7"}, {"Content-Length", "8"}})), 8u);
  EXPECT_GT(announced_bytes(head("PUT", {{"Transfer-Encoding", "chunked"}})), 0u);
}

}  // namespace
}  // namespace maggic::studio
