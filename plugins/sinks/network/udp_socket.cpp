#include "network/udp_socket.hpp"

#include <cerrno>
#include <memory>
#include <system_error>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace maggic::network {
namespace {

std::string reason(std::string_view what, int error) {
  return fmt::format("{}: {}", what, std::generic_category().message(error));
}

/// The system's number of an interface, by its name or by an address it has; 0 when there is none.
unsigned interface_index(const std::string& interface) {
  const std::optional<std::uint32_t> wanted = ipv4_from(interface);
  if (!wanted) return ::if_nametoindex(interface.c_str());
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return 0;
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> all(first, &::freeifaddrs);
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (ntohl(address->sin_addr.s_addr) == *wanted) return ::if_nametoindex(one->ifa_name);
  }
  return 0;
}

template <class T>
bool set(int descriptor, int level, int option, const T& value) {
  return ::setsockopt(descriptor, level, option, &value, sizeof value) == 0;
}

}  // namespace

std::optional<std::string> UdpSocket::open() {
  close();
  descriptor_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0) return reason("no socket", errno);
  std::optional<std::string> refusal = set_options();
  if (refusal) close();
  return refusal;
}

std::optional<std::string> UdpSocket::set_options() {
  const int on = 1;
  if (!set(descriptor_, SOL_SOCKET, SO_BROADCAST, on)) return reason("broadcast", errno);
  if (!set(descriptor_, IPPROTO_IP, IP_MULTICAST_TTL, settings_.ttl)) return reason("ttl", errno);
  const int loopback = settings_.loopback ? 1 : 0;
  if (!set(descriptor_, IPPROTO_IP, IP_MULTICAST_LOOP, loopback)) return reason("loopback", errno);
  if (settings_.interface.empty()) return std::nullopt;

  const unsigned index = interface_index(settings_.interface);
  if (index == 0) return fmt::format("there is no network interface '{}'", settings_.interface);
  ip_mreqn multicast{};
  multicast.imr_ifindex = static_cast<int>(index);
  const std::uint32_t unicast = htonl(index);
  if (!set(descriptor_, IPPROTO_IP, IP_MULTICAST_IF, multicast) ||
      !set(descriptor_, IPPROTO_IP, IP_UNICAST_IF, unicast)) {
    return reason(fmt::format("network interface '{}'", settings_.interface), errno);
  }
  return std::nullopt;
}

std::optional<Refusal> UdpSocket::send(std::string_view packet) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(settings_.port));
  to.sin_addr.s_addr = htonl(ipv4_from(settings_.address).value_or(INADDR_LOOPBACK));
  // Not connected: a connected socket would keep a route that has gone, and be told, one packet
  // late, that nobody listens at a machine that is only not listening yet.
  const ssize_t sent = ::sendto(descriptor_, packet.data(), packet.size(), MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (sent >= 0) return std::nullopt;
  const int error = errno;
  return Refusal{reason(fmt::format("to {}:{}", settings_.address, settings_.port), error),
                 error == EAGAIN || error == ENOBUFS};
}

void UdpSocket::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace maggic::network
