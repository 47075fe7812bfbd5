#include "network/udp_settings.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

namespace maggic::network {

std::optional<std::uint32_t> ipv4_from(const std::string& text) {
  in_addr address{};
  if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

void UdpSettings::describe(Parameters& p) {
  p.text({"address", "IPv4 address of a multicast group or of one machine"}, address);
  const std::optional<std::uint32_t> ipv4 = ipv4_from(address);
  p.check("address", ipv4.has_value(),
          fmt::format("found '{}', expected an IPv4 address such as 224.5.23.2", address));
  p.check("address", ipv4 != 0u,
          "found 0.0.0.0, expected the address of a multicast group or of one machine");
  p.integer({"port", "UDP port the clients listen on"}, port, {1, 65535});
  p.text({"interface", "network interface, by name or by its IPv4 address; empty: as routed"},
         interface);
  p.integer({"ttl", "networks a multicast packet may pass; 0: stays on this machine", "hops"}, ttl,
            {0, 255});
  p.boolean({"loopback", "whether multicast packets also reach programs on this machine"},
            loopback);
}

}  // namespace maggic::network
