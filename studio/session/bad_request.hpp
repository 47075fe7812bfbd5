#pragma once
/// What a session answers to something it cannot do.

#include <stdexcept>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace maggic::studio {

/// A request that was understood and refused; nothing was changed.
class BadRequest : public std::runtime_error {
 public:
  /// Answers `{"error": sentence}`. @param status an HTTP status from 400 to 599.
  BadRequest(int status, const std::string& sentence)
      : BadRequest(status, nlohmann::json{{"error", sentence}}) {}
  BadRequest(int status, const char* sentence) : BadRequest(status, std::string(sentence)) {}
  /// @param body an object with `error` or `mistakes`, valid UTF-8.
  BadRequest(int status, nlohmann::json body)
      : std::runtime_error(body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)),
        status_(status),
        body_(std::move(body)) {}

  int status() const { return status_; }
  const nlohmann::json& body() const { return body_; }

 private:
  int status_;
  nlohmann::json body_;
};

}  // namespace maggic::studio
