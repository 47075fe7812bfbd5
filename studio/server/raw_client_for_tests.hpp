#pragma once
/// A connection that sends whatever a test likes.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "studio/server/socket.hpp"

namespace maggic::studio {

class RawClient {
 public:
  /// @param receive_bytes how much the system takes before it is read; 0: as usual.
  explicit RawClient(int port, int receive_bytes = 0)
      : port_(port), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_bytes > 0) {
      ::setsockopt(socket_.descriptor(), SOL_SOCKET, SO_RCVBUF, &receive_bytes,
                   sizeof receive_bytes);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ =
        ::connect(socket_.descriptor(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }

  bool connected() const { return connected_; }

  /// @return false when the other side had enough.
  bool send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(socket_.descriptor(), text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// A request with the Host it ought to have. @param more further header lines and a body.
  bool request(std::string_view method, std::string_view target, std::string_view more = "\r\n") {
    return send(
        fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}", method, target, port_, more));
  }

  /// Everything up to and with `end`, or up to the end of the connection or of ten seconds.
  std::string read_until(std::string_view end) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (received_.find(end) == received_.npos && std::chrono::steady_clock::now() < until) {
      pollfd waited{socket_.descriptor(), POLLIN, 0};
      if (::poll(&waited, 1, 100) <= 0) continue;
      std::array<char, 65536> buffer{};
      const ssize_t got = ::recv(socket_.descriptor(), buffer.data(), buffer.size(), 0);
      if (got <= 0) {
        closed_ = true;
        break;
      }
      received_.append(buffer.data(), static_cast<std::size_t>(got));
    }
    const auto found = received_.find(end);
    const auto size = found == received_.npos ? received_.size() : found + end.size();
    std::string text = received_.substr(0, size);
    received_.erase(0, size);
    return text;
  }
  std::string read_to_end() {
    // Nothing that is sent here has this in it.
    return read_until(std::string_view("\0no such text\0", 14));
  }
  /// Whether reading met the end of the connection.
  bool closed() const { return closed_; }

 private:
  int port_;
  Socket socket_;
  bool connected_ = false;
  bool closed_ = false;
  std::string received_;
};

}  // namespace maggic::studio
