#pragma once
/// JSON out of requests and into answers.

#include <string_view>

#include <httplib.h>
#include <nlohmann/json.hpp>

namespace maggic::studio {

/// Bytes that are not UTF-8 are replaced rather than refused.
void answer_json(httplib::Response& response, int status, const nlohmann::json& body);
/// `{"error": sentence}`
void answer_error(httplib::Response& response, int status, std::string_view sentence);

/// The object a body is; an empty one where there is no body.
/// @throws BadRequest 400 for what is not JSON, not an object, or nested more than 16 deep.
nlohmann::json body_object(const httplib::Request& request);

/// The whole number of a query parameter that has to be there once.
/// @throws BadRequest 400 telling what was found instead.
int whole_number(const httplib::Request& request, const char* name);

}  // namespace maggic::studio
