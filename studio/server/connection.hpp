#pragma once
/// One connection's bytes, in and out, with limits on size and time.

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include <httplib.h>

#include "studio/server/workers.hpp"

namespace maggic::studio {

struct ConnectionLimits {
  /// A request has to be here in full after this.
  std::chrono::milliseconds request{5000};
  /// The same while others wait for a thread; browsers open connections in advance.
  std::chrono::milliseconds request_when_crowded{250};
  /// What is written has to be taken by the reader's side after this.
  std::chrono::milliseconds write{5000};
  /// Of a request, head and body together.
  std::size_t request_bytes = std::size_t{320} * 1024;
};

/// Serves one request, as the server closes every connection after one: what follows a request that
/// was refused unread can so never be taken for another request.
class Connection final : public httplib::Stream {
 public:
  /// @param socket not owned; shutting it down ends every wait here.
  Connection(int socket, const ConnectionLimits& limits, const Workers& workers);

  /// Tells that `bytes` follow what has been read.
  void announce_body(std::size_t bytes) { announced_bytes_ = read_bytes_ + bytes; }
  /// Reads off, within limits, what was announced and not read: a connection closed before it is
  /// read is reset, and the answer lost.
  void read_off();

  bool is_readable() const override;
  /// Whether there is room for more: waits for it as long as a write may take. False too when the
  /// reader has gone.
  bool is_writable() const override;
  /// @return bytes read, at least 1; 0 at the end; -1 when a limit is reached.
  ssize_t read(char* data, std::size_t size) override;
  /// @return `size`, or -1 when not all could be written.
  ssize_t write(const char* data, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Waits for bytes of the request. @return false when it took too long.
  bool wait_for_request() const;
  ssize_t receive(char* data, std::size_t size);

  const int socket_;
  const ConnectionLimits& limits_;
  const Workers& workers_;
  const Clock::time_point opened_ = Clock::now();
  std::array<char, 4096> buffer_{};
  std::size_t begin_ = 0;  ///< Of what is in the buffer and not yet read.
  std::size_t end_ = 0;
  std::size_t read_bytes_ = 0;
  std::size_t announced_bytes_ = 0;
};

}  // namespace maggic::studio
