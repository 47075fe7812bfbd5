#include "studio/server/json_answer.hpp"

#include <charconv>
#include <string>

#include <fmt/format.h>

#include "studio/session/bad_request.hpp"

namespace maggic::studio {

using nlohmann::json;

void answer_json(httplib::Response& response, int status, const json& body) {
  response.status = status;
  response.set_header("Cache-Control", "no-store");
  response.set_content(body.dump(-1, ' ', false, json::error_handler_t::replace),
                       "application/json");
}

void answer_error(httplib::Response& response, int status, std::string_view sentence) {
  answer_json(response, status, {{"error", sentence}});
}

json body_object(const httplib::Request& request) {
  // Whoever walks through it may do so recursively.
  constexpr int kDeepest = 16;
  if (request.body.empty()) return json::object();
  json body;
  try {
    body = json::parse(request.body, [](int depth, json::parse_event_t, const json&) {
      if (depth > kDeepest) throw BadRequest(400, "the body is nested more than 16 deep");
      return true;
    });
  } catch (const json::exception& error) {
    throw BadRequest(400, fmt::format("the body is not JSON: {}", error.what()));
  }
  if (!body.is_object()) {
    throw BadRequest(400, fmt::format("the body: found {}, expected an object", body.type_name()));
  }
  return body;
}

int whole_number(const httplib::Request& request, const char* name) {
  if (request.get_param_value_count(name) != 1) {
    throw BadRequest(400, fmt::format("{}: expected in the address, once", name));
  }
  const std::string text = request.get_param_value(name);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw BadRequest(400, fmt::format("{}: found '{}', expected a whole number", name, text));
  }
  return number;
}

}  // namespace maggic::studio
