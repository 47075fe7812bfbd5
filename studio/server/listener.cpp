#include "studio/server/listener.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace maggic::studio {
namespace {

/// Connections the system keeps until they are accepted.
constexpr int kBacklog = 512;

[[noreturn]] void fail(const std::string& address, int port, std::string_view reason) {
  throw std::runtime_error(fmt::format("port {} of {} cannot be used: {}", port, address, reason));
}

std::string text_of(int error) { return std::generic_category().message(error); }

int port_of(int descriptor) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&bound), &size) != 0) return 0;
  return ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(bound).sin6_port
                                           : reinterpret_cast<const sockaddr_in&>(bound).sin_port);
}

/// @return none, with errno telling why, where it cannot be.
Socket listen_at(const addrinfo& where) {
  Socket socket(::socket(where.ai_family, where.ai_socktype | SOCK_CLOEXEC, where.ai_protocol));
  if (!socket) return {};
  // A port whose last user has just gone may be used at once; one in use may not be shared.
  const int yes = 1;
  ::setsockopt(socket.descriptor(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(socket.descriptor(), where.ai_addr, where.ai_addrlen) != 0 ||
      ::listen(socket.descriptor(), kBacklog) != 0) {
    const int reason = errno;
    socket = Socket();
    errno = reason;
  }
  return socket;
}

}  // namespace

Listener::Listener(const std::string& address, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string service = std::to_string(port);
  if (const int error = ::getaddrinfo(address.c_str(), service.c_str(), &wanted, &found)) {
    fail(address, port, ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  int reason = 0;
  for (const addrinfo* at = found; at != nullptr && !socket_; at = at->ai_next) {
    socket_ = listen_at(*at);
    if (!socket_) reason = errno;
  }
  if (!socket_) fail(address, port, text_of(reason));
  port_ = port_of(socket_.descriptor());
}

Socket Listener::accept() {
  Socket connection(::accept4(socket_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC));
  if (connection) {
    // Answers are written whole; the system need not wait for more.
    const int yes = 1;
    ::setsockopt(connection.descriptor(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    // What a slow reader has not been sent should be in our hands, where a newer picture can take
    // its place.
    const int most_unsent_bytes = 64 * 1024;
    ::setsockopt(connection.descriptor(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most_unsent_bytes,
                 sizeof most_unsent_bytes);
  }
  return connection;
}

void Listener::stop() { ::shutdown(socket_.descriptor(), SHUT_RDWR); }

}  // namespace maggic::studio
