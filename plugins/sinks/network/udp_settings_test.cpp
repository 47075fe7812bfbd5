#include "network/udp_settings.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "maggic/parameter_reader.hpp"
#include "maggic/testing.hpp"

namespace maggic::network {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ReadingUdpSettings : public ::testing::Test {
 protected:
  /// What is wrong with a sink's parameters, with places.
  std::vector<std::string> mistakes_in(const std::string& yaml) {
    std::vector<Mistake> mistakes;
    read_parameters(
        parse_document(yaml, "sink.yaml"), testing::standard_palette(),
        [&](Parameters& p) { settings_.describe(p); }, mistakes);
    std::vector<std::string> sentences;
    for (const Mistake& mistake : mistakes) sentences.push_back(mistake.to_string());
    return sentences;
  }

  UdpSettings settings_{.address = "224.5.23.2", .port = 10015};
};

TEST_F(ReadingUdpSettings, KeepsTheSinksOwnDefaults) {
  EXPECT_THAT(mistakes_in("{}"), IsEmpty());
  EXPECT_EQ(settings_.address, "224.5.23.2");
  EXPECT_EQ(settings_.port, 10015);
  EXPECT_EQ(settings_.interface, "");
  EXPECT_EQ(settings_.ttl, 1);
  EXPECT_TRUE(settings_.loopback);
}

TEST_F(ReadingUdpSettings, TakesEveryParameter) {
  EXPECT_THAT(mistakes_in("{address: 10.0.0.7, port: 20011, interface: eth0, ttl: 4, "
                          "loopback: false}"),
              IsEmpty());
  EXPECT_EQ(settings_.address, "10.0.0.7");
  EXPECT_EQ(settings_.port, 20011);
  EXPECT_EQ(settings_.interface, "eth0");
  EXPECT_EQ(settings_.ttl, 4);
  EXPECT_FALSE(settings_.loopback);
}

TEST_F(ReadingUdpSettings, SaysWhereAnAddressIsNone) {
  EXPECT_THAT(mistakes_in("port: 10006\naddress: vision.local\n"),
              ElementsAre("sink.yaml:2:10: address: found 'vision.local', expected an IPv4 address "
                          "such as 224.5.23.2"));
}

TEST_F(ReadingUdpSettings, RefusesTheAddressOfNobody) {
  EXPECT_THAT(mistakes_in("address: 0.0.0.0"),
              ElementsAre("sink.yaml:1:10: address: found 0.0.0.0, expected the address of a "
                          "multicast group or of one machine"));
}

TEST_F(ReadingUdpSettings, RefusesPortsThatDoNotExist) {
  EXPECT_EQ(mistakes_in("port: 0").size(), 1U);
  EXPECT_EQ(mistakes_in("port: 65536").size(), 1U);
  EXPECT_THAT(mistakes_in("port: 65535"), IsEmpty());
}

TEST(Ipv4Address, IsFourNumbersWithPointsBetweenThem) {
  EXPECT_EQ(ipv4_from("224.5.23.2"), 0xE0051702U);
  EXPECT_EQ(ipv4_from("0.0.0.0"), 0U);
  EXPECT_EQ(ipv4_from("255.255.255.255"), 0xFFFFFFFFU);
  for (const char* text : {"", "localhost", "1.2.3", "1.2.3.256", "1.2.3.4.5", "1.2.3.4 ", "::1",
                           "1.2.3.-4", "1,2,3,4"}) {
    EXPECT_EQ(ipv4_from(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace maggic::network
