#pragma once
/// The Studio's web server.

#include <memory>
#include <string>

#include "studio/server/connection.hpp"
#include "studio/session/session.hpp"

namespace maggic::studio {

struct ServerOptions {
  std::string listen = "127.0.0.1";  ///< Numeric address or name of this machine.
  int port = 8642;                   ///< 0: any free one.
  /// Asked of every request; empty: none on an address only this machine reaches, else a random
  /// one.
  std::string token;
  int most_picture_streams = 8;
  int most_event_streams = 16;
  ConnectionLimits connection;
};

/// Serves a session and the page from its construction to stop() or destruction.
class Server {
 public:
  /// @param session outlives this.
  /// @throws std::runtime_error naming address and port when they cannot be used.
  Server(Session& session, const ServerOptions& options);
  ~Server();

  int port() const;
  /// Asked of every request; empty: none.
  const std::string& token() const;
  /// What to give to a browser, with the token in it.
  std::string url() const;

  /// Ends every stream and waits for what is being answered; well under a second if the session's
  /// answers are.
  void stop();

 private:
  class Handler;

  std::unique_ptr<Handler> handler_;
};

}  // namespace maggic::studio
