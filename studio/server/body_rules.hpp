#pragma once
/// Which bodies of requests are read at all.

#include <cstddef>
#include <optional>

#include <httplib.h>

namespace maggic::studio {

inline constexpr std::size_t kMostBodyBytes = std::size_t{256} * 1024;

struct Refusal {
  int status = 0;  ///< Of HTTP.
  const char* sentence = "";
};

/// Judges a request by its head: a body has to be JSON, sent as it is, of a length told in advance
/// and at most kMostBodyBytes, and to come with PUT or POST.
/// @return nothing when there is nothing to refuse.
std::optional<Refusal> refuse_body(const httplib::Request& head);

/// How much may follow a head, whatever else is wrong with it.
std::size_t announced_bytes(const httplib::Request& head);

}  // namespace maggic::studio
