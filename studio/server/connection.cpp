#include "studio/server/connection.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace maggic::studio {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Waits for `events`. @return what came, 0 when nothing did in time.
short wait_for(int socket, short events, steady_clock::duration time) {
  const auto until = steady_clock::now() + time;
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    pollfd waited{socket, events, 0};
    const int count = ::poll(&waited, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
    if (count > 0) return waited.revents;
    if (count == 0) return 0;
    if (errno != EINTR) return POLLERR;
  }
}

void address_text(int (*name_of)(int, sockaddr*, socklen_t*), int socket, std::string& ip,
                  int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  if (name_of(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
      ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host.data(), host.size(),
                    service.data(), service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  port = std::atoi(service.data());
}

}  // namespace

Connection::Connection(int socket, const ConnectionLimits& limits, const Workers& workers)
    : socket_(socket), limits_(limits), workers_(workers) {}

void Connection::read_off() {
  constexpr std::size_t kMostBytes = 4 << 20;
  constexpr milliseconds kLongest(500);
  if (announced_bytes_ <= read_bytes_) return;
  ::shutdown(socket_, SHUT_WR);
  const auto until = Clock::now() + kLongest;
  std::size_t left = std::min(announced_bytes_ - read_bytes_, kMostBytes);
  left -= std::min(left, end_ - begin_);
  while (left > 0 && (wait_for(socket_, POLLIN, until - Clock::now()) & POLLIN) != 0) {
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got <= 0) return;
    left -= std::min(left, static_cast<std::size_t>(got));
  }
}

bool Connection::is_readable() const {
  return begin_ < end_ || (wait_for(socket_, POLLIN, milliseconds(0)) & POLLIN) != 0;
}

bool Connection::is_writable() const {
  const short events = wait_for(socket_, POLLOUT | POLLRDHUP, limits_.write);
  return (events & POLLOUT) != 0 && (events & (POLLRDHUP | POLLHUP | POLLERR)) == 0;
}

bool Connection::wait_for_request() const {
  constexpr milliseconds kLook(50);
  for (;;) {
    const bool came = wait_for(socket_, POLLIN, kLook) != 0;
    const auto longest = workers_.crowded() ? limits_.request_when_crowded : limits_.request;
    if (Clock::now() - opened_ > longest) return false;
    if (came) return true;
  }
}

ssize_t Connection::receive(char* data, std::size_t size) {
  for (;;) {
    if (!wait_for_request()) return -1;
    const ssize_t got = ::recv(socket_, data, size, MSG_DONTWAIT);
    if (got >= 0) return got;
    if (errno != EINTR && errno != EAGAIN) return -1;
  }
}

ssize_t Connection::read(char* data, std::size_t size) {
  if (begin_ == end_) {
    const ssize_t got = receive(buffer_.data(), buffer_.size());
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  const std::size_t count = std::min(size, end_ - begin_);
  if (read_bytes_ + count > limits_.request_bytes) return -1;
  std::memcpy(data, buffer_.data() + begin_, count);
  begin_ += count;
  read_bytes_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* data, std::size_t size) {
  const auto until = Clock::now() + limits_.write;
  for (std::size_t written = 0; written < size;) {
    const ssize_t count =
        ::send(socket_, data + written, size - written, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      if (wait_for(socket_, POLLOUT, until - Clock::now()) == 0) return -1;
    } else if (errno != EINTR) {
      return -1;
    }
    if (written < size && Clock::now() > until) return -1;
  }
  return static_cast<ssize_t>(size);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  address_text(&::getpeername, socket_, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  address_text(&::getsockname, socket_, ip, port);
}

}  // namespace maggic::studio
