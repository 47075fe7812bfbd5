#pragma once
/// A sender for `tcp://` streams: gives every caller the same bytes and hangs up.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace maggic::video {

class FileServer {
 public:
  /// Takes a free port of this machine, but answers only once `begin` is called.
  explicit FileServer(std::string bytes) : bytes_(std::move(bytes)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_, generic, length) != 0 || ::getsockname(socket_, generic, &length) != 0) {
      throw std::runtime_error("no port for the test's server");
    }
    port_ = ntohs(address.sin_port);
  }
  ~FileServer() {
    end_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
  }
  FileServer(const FileServer&) = delete;
  FileServer& operator=(const FileServer&) = delete;

  void begin() {
    ::listen(socket_, 4);
    thread_ = std::thread([this] { serve(); });
  }

  std::string url() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  int served() const { return served_; }

 private:
  void serve() {
    while (!end_) {
      pollfd waiting{socket_, POLLIN, 0};
      if (::poll(&waiting, 1, 5) <= 0) continue;
      const int caller = ::accept(socket_, nullptr, nullptr);
      for (std::size_t sent = 0; sent < bytes_.size();) {
        const ssize_t part =
            ::send(caller, bytes_.data() + sent, bytes_.size() - sent, MSG_NOSIGNAL);
        if (part <= 0) break;
        sent += static_cast<std::size_t>(part);
      }
      ::close(caller);
      ++served_;
    }
  }

  const std::string bytes_;
  const int socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int port_ = 0;
  std::atomic<bool> end_{false};
  std::atomic<int> served_{0};
  std::thread thread_;
};

}  // namespace maggic::video
