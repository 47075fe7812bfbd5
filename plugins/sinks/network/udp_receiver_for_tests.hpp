#pragma once
/// What a client does: listens at a port of this machine.

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace maggic::network {

class UdpReceiver {
 public:
  /// On a port the system chooses. @param any_address false: at 127.0.0.1 alone, which is not
  /// enough for multicast groups.
  explicit UdpReceiver(bool any_address = false) {
    descriptor_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(any_address ? INADDR_ANY : INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    const timeval patience{10, 0};
    if (descriptor_ < 0 || ::bind(descriptor_, reinterpret_cast<sockaddr*>(&here), size) != 0 ||
        ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&here), &size) != 0 ||
        ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0) {
      throw std::runtime_error("cannot listen at 127.0.0.1");
    }
    port_ = ntohs(here.sin_port);
  }
  ~UdpReceiver() { ::close(descriptor_); }
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  /// Also takes what is sent to a multicast group over this machine's own interface.
  /// @return false when this system has no multicast there.
  bool join(const std::string& group) {
    ip_mreqn membership{};
    membership.imr_multiaddr.s_addr = ::inet_addr(group.c_str());
    membership.imr_address.s_addr = htonl(INADDR_LOOPBACK);
    return ::setsockopt(descriptor_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership,
                        sizeof membership) == 0;
  }

  int port() const { return port_; }
  /// Parameters of a network sink that sends here, and `more` of them, each after a comma.
  std::string parameters(const std::string& more = "") const {
    return "{address: 127.0.0.1, port: " + std::to_string(port_) + more + "}";
  }

  /// Waits for the next packet. @throws std::runtime_error when none comes.
  std::string receive() {
    const ssize_t size = ::recv(descriptor_, buffer_.data(), buffer_.size(), 0);
    if (size < 0) throw std::runtime_error("no packet came");
    return {buffer_.data(), static_cast<std::size_t>(size)};
  }

  /// Whether there is none waiting; what was sent to this machine before is there already.
  bool is_empty() {
    return ::recv(descriptor_, buffer_.data(), buffer_.size(), MSG_DONTWAIT | MSG_PEEK) < 0;
  }

 private:
  int descriptor_ = -1;
  int port_ = 0;
  std::array<char, 65536> buffer_;
};

}  // namespace maggic::network
