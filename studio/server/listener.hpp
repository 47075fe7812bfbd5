#pragma once
/// The socket that connections come to.

#include <string>

#include "studio/server/socket.hpp"

namespace maggic::studio {

class Listener {
 public:
  /// @param address a numeric address or a name of this machine.
  /// @param port 0 to 65535; 0: any free one.
  /// @throws std::runtime_error naming address, port and what the system says.
  Listener(const std::string& address, int port);

  /// The port in use, even where 0 was asked for.
  int port() const { return port_; }
  int descriptor() const { return socket_.descriptor(); }
  /// Waits for a connection. @return none when there is one that cannot be taken, or after stop().
  Socket accept();
  /// Ends accept(), now and from now on; safe from any thread.
  void stop();

 private:
  Socket socket_;
  int port_ = 0;
};

}  // namespace maggic::studio
