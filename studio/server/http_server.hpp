#pragma once
/// HTTP/1.1 over a listener: threads, connections, limits. What is answered is another's business.

#include <cstddef>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include <httplib.h>

#include "studio/server/connection.hpp"
#include "studio/server/listener.hpp"
#include "studio/server/stop_flag.hpp"
#include "studio/server/workers.hpp"

namespace maggic::studio {

/// Answers requests; called from several threads, must not throw.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;

  /// The head of a request is here, its body not yet.
  /// @return true when `response` is the answer; false when the body is to be read first.
  virtual bool answer_head(const httplib::Request& request, httplib::Response& response) = 0;
  /// The body is here too; only after answer_head() said false.
  virtual void answer(const httplib::Request& request, httplib::Response& response) = 0;
};

/// Serves from its construction to stop() or destruction. Every connection carries one request.
class HttpServer : private httplib::Server {
 public:
  /// @param handler outlives this.
  HttpServer(Listener& listener, const ConnectionLimits& limits, std::size_t most_threads,
             HttpHandler& handler);
  ~HttpServer() override;

  /// Ends every connection, answered or not, and waits for their threads.
  void stop();

 private:
  /// A connection that stop() has to end.
  class Open;

  void accept_connections();
  void serve(Socket connection);

  Listener& listener_;
  const ConnectionLimits limits_;
  StopFlag stopping_;
  std::mutex open_mutex_;
  std::set<int> open_;
  std::optional<Workers> workers_;
  std::thread accepting_;
};

}  // namespace maggic::studio
