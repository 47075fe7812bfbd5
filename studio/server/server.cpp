#include "studio/server/server.hpp"

#include <cstddef>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "studio/server/access_rules.hpp"
#include "studio/server/api.hpp"
#include "studio/server/body_rules.hpp"
#include "studio/server/http_server.hpp"
#include "studio/server/json_answer.hpp"
#include "studio/server/listener.hpp"
#include "studio/server/page_files.hpp"
#include "studio/server/reachable_address.hpp"
#include "studio/server/routes.hpp"
#include "studio/server/stream_slots.hpp"

namespace maggic::studio {
namespace {

/// For everything but streams, which have threads of their own.
constexpr std::size_t kRequestThreads = 24;

std::string chosen_token(const ServerOptions& options) {
  if (!options.token.empty() || is_loopback(options.listen)) return options.token;
  return random_token();
}

std::vector<std::string> headers_of(const httplib::Request& request, const std::string& name) {
  std::vector<std::string> values;
  const auto [begin, end] = request.headers.equal_range(name);
  for (auto at = begin; at != end; ++at) values.push_back(at->second);
  return values;
}

RequestOrigin origin_of(const httplib::Request& request) {
  RequestOrigin origin{.host = headers_of(request, "Host"),
                       .origin = headers_of(request, "Origin"),
                       .fetch_site = headers_of(request, "Sec-Fetch-Site"),
                       .authorization = headers_of(request, "Authorization"),
                       .cookie = headers_of(request, "Cookie")};
  const auto [begin, end] = request.params.equal_range("token");
  for (auto at = begin; at != end; ++at) origin.token_parameter.push_back(at->second);
  return origin;
}

void set_protective_headers(httplib::Response& response) {
  response.set_header("Content-Security-Policy",
                      "default-src 'self'; img-src 'self' data: blob:; base-uri 'none'; "
                      "form-action 'self'; frame-ancestors 'none'");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  // The address may hold the token.
  response.set_header("Referrer-Policy", "no-referrer");
}

}  // namespace

/// The way of a request: who asks, for what, how; then the route's own handler.
class Server::Handler final : public HttpHandler {
 public:
  Handler(Session& session, const ServerOptions& options)
      : listener_(options.listen, options.port),
        listen_(options.listen),
        access_(options.listen, listener_.port(), chosen_token(options)),
        picture_slots_(options.most_picture_streams),
        event_slots_(options.most_event_streams) {
    add_api_routes(routes_, {session, picture_slots_, event_slots_, stop_});
    add_page_routes(routes_);
    const auto threads = kRequestThreads + static_cast<std::size_t>(options.most_picture_streams +
                                                                    options.most_event_streams);
    http_.emplace(listener_, options.connection, threads, *this);
  }

  int port() const { return listener_.port(); }
  const std::string& listen() const { return listen_; }
  const std::string& token() const { return access_.token(); }

  void stop() {
    stop_.raise();
    http_->stop();
  }

  bool answer_head(const httplib::Request& request, httplib::Response& response) override {
    set_protective_headers(response);
    if (!admit(request, response)) return true;
    const Routes::Match match = routes_.find(request.method, request.path);
    if (!match.known) {
      answer_error(response, 404, "there is nothing of this address");
    } else if (match.handler == nullptr) {
      response.set_header("Allow", match.methods);
      answer_error(response, 405, fmt::format("this address takes {} only", match.methods));
    } else if (const auto refusal = refuse_body(request)) {
      answer_error(response, refusal->status, refusal->sentence);
    } else if (request.method == "PUT" || request.method == "POST") {
      return false;
    } else {
      run(match, request, response);
    }
    return true;
  }

  void answer(const httplib::Request& request, httplib::Response& response) override {
    run(routes_.find(request.method, request.path), request, response);
  }

 private:
  /// @return false when the answer is that the request may not be made.
  bool admit(const httplib::Request& request, httplib::Response& response) const {
    switch (access_.judge(origin_of(request), request.path.starts_with("/api/"))) {
      case Access::kForbidden:
        answer_error(response, 403, "this address is not open to requests from elsewhere");
        return false;
      case Access::kTokenMissing:
        response.set_header("WWW-Authenticate", "Bearer");
        answer_error(response, 401, "open the address that was printed when the Studio started");
        return false;
      case Access::kGrantedByParameter:
        response.set_header("Set-Cookie", access_.cookie());
        return true;
      case Access::kGranted: return true;
    }
    return false;
  }

  void run(const Routes::Match& match, const httplib::Request& request,
           httplib::Response& response) const {
    try {
      (*match.handler)(request, match.name, response);
    } catch (const BadRequest& refused) {
      answer_json(response, refused.status(), refused.body());
    } catch (const std::exception& failure) {
      answer_error(response, 500, failure.what());
    }
  }

  Listener listener_;
  const std::string listen_;
  const AccessRules access_;
  StreamSlots picture_slots_;
  StreamSlots event_slots_;
  StopFlag stop_;
  Routes routes_;
  std::optional<HttpServer> http_;
};

Server::Server(Session& session, const ServerOptions& options)
    : handler_(std::make_unique<Handler>(session, options)) {}

Server::~Server() { stop(); }

int Server::port() const { return handler_->port(); }

const std::string& Server::token() const { return handler_->token(); }

std::string Server::url() const {
  const std::string address = reachable_address(handler_->listen());
  const bool brackets = address.find(':') != address.npos;
  std::string url =
      fmt::format("http://{}{}{}:{}/", brackets ? "[" : "", address, brackets ? "]" : "", port());
  if (!token().empty()) url += "?token=" + token();
  return url;
}

void Server::stop() { handler_->stop(); }

}  // namespace maggic::studio
