#include "studio/server/http_server.hpp"

#include <sys/socket.h>

#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "studio/server/body_rules.hpp"
#include "studio/server/json_answer.hpp"

namespace maggic::studio {
namespace {

/// Told apart by what httplib itself refuses, before a handler is asked.
const char* sentence_of(int status) {
  switch (status) {
    case 414: return "the address is too long";
    case 416: return "parts of an answer are not given";
    default: return "this is not a request as HTTP/1.1 has them";
  }
}

void prepare(httplib::Request& request, Connection& connection) {
  // Compressing would cost more of this machine than it saves of a wire that is mostly none, and
  // answers are given whole.
  request.headers.erase("Accept-Encoding");
  request.ranges.clear();
  connection.announce_body(announced_bytes(request));
  // Without a length there is no body; httplib would read on until the connection ends.
  if (!request.has_header("Content-Length")) request.set_header("Content-Length", "0");
}

}  // namespace

class HttpServer::Open {
 public:
  Open(HttpServer& server, int descriptor) : server_(server), descriptor_(descriptor) {
    const std::lock_guard lock(server_.open_mutex_);
    welcome_ = !server_.stopping_.raised();
    if (welcome_) server_.open_.insert(descriptor_);
  }
  ~Open() {
    const std::lock_guard lock(server_.open_mutex_);
    server_.open_.erase(descriptor_);
  }
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;

  bool welcome() const { return welcome_; }

 private:
  HttpServer& server_;
  const int descriptor_;
  bool welcome_ = false;
};

HttpServer::HttpServer(Listener& listener, const ConnectionLimits& limits, std::size_t most_threads,
                       HttpHandler& handler)
    : listener_(listener), limits_(limits) {
  svr_sock_ = listener_.descriptor();  // Where httplib looks whether it is still to serve.
  set_pre_routing_handler([&handler](const httplib::Request& request, httplib::Response& response) {
    return handler.answer_head(request, response) ? HandlerResponse::Handled
                                                  : HandlerResponse::Unhandled;
  });
  const auto with_body = [&handler](const httplib::Request& request, httplib::Response& response) {
    handler.answer(request, response);
  };
  Put("/.*", with_body);
  Post("/.*", with_body);
  set_error_handler(HandlerWithResponse([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) {
      answer_error(response, response.status, sentence_of(response.status));
    }
    return HandlerResponse::Handled;
  }));
  workers_.emplace(most_threads, [this](Socket connection) { serve(std::move(connection)); });
  accepting_ = std::thread([this] { accept_connections(); });
}

HttpServer::~HttpServer() { stop(); }

void HttpServer::stop() {
  if (stopping_.raised()) return;
  {
    const std::lock_guard lock(open_mutex_);
    stopping_.raise();
    svr_sock_ = INVALID_SOCKET;
    for (const int descriptor : open_) ::shutdown(descriptor, SHUT_RDWR);
  }
  listener_.stop();
  accepting_.join();
  workers_.reset();
}

void HttpServer::accept_connections() {
  using namespace std::chrono_literals;
  while (!stopping_.raised()) {
    Socket connection = listener_.accept();
    if (connection) {
      workers_->add(std::move(connection));
    } else {
      // Most often too many open files; some will be closed.
      stopping_.wait_until(std::chrono::steady_clock::now() + 10ms);
    }
  }
}

void HttpServer::serve(Socket socket) {
  const Open open(*this, socket.descriptor());
  if (!open.welcome()) return;
  try {
    Connection connection(socket.descriptor(), limits_, *workers_);
    bool closed = false;
    process_request(connection, /*close_connection=*/true, closed,
                    [&connection](httplib::Request& request) { prepare(request, connection); });
    connection.read_off();
  } catch (const std::exception&) {
    // Out of memory, at worst: this connection ends, the others go on.
  }
}

}  // namespace maggic::studio
