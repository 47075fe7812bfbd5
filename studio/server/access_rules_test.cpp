/// Who is let in.

#include "studio/server/access_rules.hpp"

#include <set>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace maggic::studio {
namespace {

const AccessRules& loopback() {
  static const AccessRules rules("127.0.0.1", 8642, "");
  return rules;
}

TEST(AccessRulesTest, TheHostHasToBeThisMachineByItsOwnNamesAndPort) {
  for (const char* host :
       {"localhost:8642", "127.0.0.1:8642", "[::1]:8642", "LocalHost:8642", "LOCALHOST:8642"}) {
    EXPECT_EQ(loopback().judge({.host = {host}}, true), Access::kGranted) << host;
  }
  for (const char* host :
       {"", "localhost", "localhost:", "localhost:80", "localhost:86421", "127.0.0.1",
        "evil.example", "evil.example:8642", "localhost.evil.example:8642",
        "127.0.0.1.evil.example:8642", "127.0.0.2:8642", "192.168.1.5:8642", "[::1]", "[::2]:8642",
        "::1:8642", "localhost:8642:8642", "localhost:8642,evil.example", " localhost:8642"}) {
    EXPECT_EQ(loopback().judge({.host = {host}}, true), Access::kForbidden) << host;
    EXPECT_EQ(loopback().judge({.host = {host}}, false), Access::kForbidden) << host;
  }
}

TEST(AccessRulesTest, OneHostHasToBeThere) {
  EXPECT_EQ(loopback().judge({}, true), Access::kForbidden);
  EXPECT_EQ(loopback().judge({.host = {"localhost:8642", "evil.example"}}, true),
            Access::kForbidden);
  EXPECT_EQ(loopback().judge({.host = {"localhost:8642", "localhost:8642"}}, true),
            Access::kForbidden);
}

TEST(AccessRulesTest, PortEightyNeedNotBeTold) {
  EXPECT_EQ(AccessRules("127.0.0.1", 80, "").judge({.host = {"localhost"}}, true),
            Access::kGranted);
  EXPECT_EQ(AccessRules("127.0.0.1", 80, "").judge({.host = {"[::1]"}}, true), Access::kGranted);
}

TEST(AccessRulesTest, AnOriginHasToBeTheVeryHostThatIsAsked) {
  const auto judge = [](const char* host, std::vector<std::string> origin) {
    return loopback().judge({.host = {host}, .origin = std::move(origin)}, false);
  };
  EXPECT_EQ(judge("localhost:8642", {"http://localhost:8642"}), Access::kGranted);
  EXPECT_EQ(judge("[::1]:8642", {"http://[::1]:8642"}), Access::kGranted);
  for (const char* origin : {"null", "", "http://evil.example", "http://localhost:8643",
                             "http://localhost", "https://localhost:8642", "http://127.0.0.1:8642",
                             "http://localhost:8642.evil.example", "http://localhost:8642/"}) {
    EXPECT_EQ(judge("localhost:8642", {origin}), Access::kForbidden) << origin;
  }
  EXPECT_EQ(judge("localhost:8642", {"http://localhost:8642", "http://evil.example"}),
            Access::kForbidden);
}

TEST(AccessRulesTest, AForeignPageMayLinkToThePageButNotUseTheApi) {
  for (const char* site : {"cross-site", "same-site"}) {
    const RequestOrigin request{.host = {"localhost:8642"}, .fetch_site = {site}};
    EXPECT_EQ(loopback().judge(request, true), Access::kForbidden) << site;
    EXPECT_EQ(loopback().judge(request, false), Access::kGranted) << site;
  }
  for (const char* site : {"same-origin", "none"}) {
    EXPECT_EQ(loopback().judge({.host = {"localhost:8642"}, .fetch_site = {site}}, true),
              Access::kGranted)
        << site;
  }
}

TEST(AccessRulesTest, TheAddressListenedOnIsAHostToo) {
  const AccessRules rules("192.168.1.5", 8642, "secret");
  EXPECT_EQ(rules.judge({.host = {"192.168.1.5:8642"}}, true), Access::kTokenMissing);
  EXPECT_EQ(rules.judge({.host = {"192.168.1.6:8642"}}, true), Access::kForbidden);
  const AccessRules six("fe80::1", 8642, "secret");
  EXPECT_EQ(six.judge({.host = {"[fe80::1]:8642"}}, true), Access::kTokenMissing);
}

TEST(AccessRulesTest, ListeningEverywhereTakesNumbersButNoNames) {
  const AccessRules rules("0.0.0.0", 8642, "secret");
  for (const char* host :
       {"192.168.1.5:8642", "10.0.0.1:8642", "[fe80::1]:8642", "localhost:8642"}) {
    EXPECT_EQ(rules.judge({.host = {host}}, true), Access::kTokenMissing) << host;
  }
  for (const char* host :
       {"evil.example:8642", "192.168.1.5:80", "192.168.1:8642", "1.2.3.4.5:8642", "[evil]:8642",
        "[]:8642", "192.168.1.5.evil.example:8642"}) {
    EXPECT_EQ(rules.judge({.host = {host}}, true), Access::kForbidden) << host;
  }
  const std::string with_nul("192.168.1.5\0.evil.example:8642", 30);
  EXPECT_EQ(rules.judge({.host = {with_nul}}, true), Access::kForbidden);
}

class TokenTest : public ::testing::Test {
 protected:
  Access judge(RequestOrigin request) const {
    request.host = {"192.168.1.5:8642"};
    return rules_.judge(request, true);
  }
  const AccessRules rules_{"192.168.1.5", 8642, "secret"};
};

TEST_F(TokenTest, MayComeInAHeaderACookieOrTheAddress) {
  EXPECT_EQ(judge({}), Access::kTokenMissing);
  EXPECT_EQ(judge({.authorization = {"Bearer secret"}}), Access::kGranted);
  EXPECT_EQ(judge({.cookie = {"maggic_studio_8642=secret"}}), Access::kGranted);
  EXPECT_EQ(judge({.cookie = {"theme=dark; maggic_studio_8642=secret; a=b"}}), Access::kGranted);
  EXPECT_EQ(judge({.token_parameter = {"secret"}}), Access::kGrantedByParameter);
}

TEST_F(TokenTest, HasToBeTheWholeTokenInItsOwnPlace) {
  for (const char* value : {"", "secret", "Bearer", "Bearer ", "Bearer secre", "Bearer secrets",
                            "Bearer Secret", "Basic secret"}) {
    EXPECT_EQ(judge({.authorization = {value}}), Access::kTokenMissing) << value;
  }
  for (const char* value : {"", ";", "=", "secret", "maggic_studio_8642", "maggic_studio_8642=",
                            "maggic_studio_8643=secret", "x_maggic_studio_8642=secret",
                            "maggic_studio_8642=secret=", "maggic_studio_8642=x;secret"}) {
    EXPECT_EQ(judge({.cookie = {value}}), Access::kTokenMissing) << value;
  }
  EXPECT_EQ(judge({.token_parameter = {""}}), Access::kTokenMissing);
  EXPECT_EQ(judge({.token_parameter = {"secret", "secret"}}), Access::kTokenMissing);
}

TEST_F(TokenTest, DoesNotOpenWhatAWrongHostOrOriginCloses) {
  EXPECT_EQ(rules_.judge({.host = {"evil.example"}, .authorization = {"Bearer secret"}}, true),
            Access::kForbidden);
  EXPECT_EQ(judge({.origin = {"http://evil.example"}, .cookie = {"maggic_studio_8642=secret"}}),
            Access::kForbidden);
}

TEST_F(TokenTest, IsKeptInACookieThatScriptsAndOtherPagesDoNotGet) {
  EXPECT_EQ(rules_.cookie(), "maggic_studio_8642=secret; Path=/; HttpOnly; SameSite=Strict");
}

TEST(LoopbackTest, IsWhatOnlyThisMachineReaches) {
  for (const char* address : {"localhost", "127.0.0.1", "127.8.9.1", "::1"}) {
    EXPECT_TRUE(is_loopback(address)) << address;
  }
  for (const char* address : {"0.0.0.0", "::", "192.168.1.5", "127.evil.example", "pit", ""}) {
    EXPECT_FALSE(is_loopback(address)) << address;
  }
}

TEST(RandomTokenTest, IsLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_THAT(*tokens.begin(), ::testing::MatchesRegex("[0-9a-f]+"));
  EXPECT_EQ(tokens.begin()->size(), 32u);
}

RC_GTEST_PROP(AccessRulesProperty, NoOtherHostIsLetIn, (const std::string& host)) {
  RC_ASSERT(loopback().judge({.host = {host}}, true) == Access::kForbidden);
  RC_ASSERT(loopback().judge({.host = {host + ":8642"}}, true) == Access::kForbidden);
}

RC_GTEST_PROP(AccessRulesProperty, NoOtherTokenIsLetIn, (const std::string& text)) {
  RC_PRE(text != "secret");
  const AccessRules rules("192.168.1.5", 8642, "secret");
  const RequestOrigin request{.host = {"192.168.1.5:8642"},
                              .authorization = {text, "Bearer " + text},
                              .cookie = {text, "maggic_studio_8642=" + text},
                              .token_parameter = {text}};
  RC_ASSERT(rules.judge(request, true) == Access::kTokenMissing);
}

}  // namespace
}  // namespace maggic::studio
