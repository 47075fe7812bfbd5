#pragma once
/// Who may talk to the Studio.

#include <string>
#include <string_view>
#include <vector>

namespace maggic::studio {

/// What a request tells of where it comes from: every value of each header or parameter, as a
/// second one may be there to slip past a look at the first.
struct RequestOrigin {
  std::vector<std::string> host;
  std::vector<std::string> origin;
  std::vector<std::string> fetch_site;  ///< Sec-Fetch-Site
  std::vector<std::string> authorization;
  std::vector<std::string> cookie;
  std::vector<std::string> token_parameter;
};

enum class Access {
  kGranted,
  kGrantedByParameter,  ///< The token was in the address; a cookie should take its place.
  kTokenMissing,        ///< 401
  kForbidden,           ///< 403
};

/// A server on the loopback address is within reach of every page the same browser has open. What
/// keeps those away: they cannot choose the headers Host, Origin and Sec-Fetch-Site. A page of a
/// foreign name that was made to stand for this machine (DNS rebinding) sends its own name as Host.
class AccessRules {
 public:
  /// @param listen_address what the server listens on. On an address of all (`0.0.0.0`, `::`) any
  ///        numeric address is taken as Host, as only names can be rebound.
  /// @param token asked of every request; empty: none is.
  AccessRules(std::string_view listen_address, int port, std::string token);

  /// @param of_api whether the request is for `/api`, where a foreign page has no business at all;
  ///        a link to the page itself is fine.
  Access judge(const RequestOrigin& request, bool of_api) const;

  const std::string& token() const { return token_; }
  /// For Set-Cookie; not sent along by requests of other pages, and not seen by scripts.
  std::string cookie() const;

 private:
  bool is_us(std::string_view host) const;
  bool has_token(const RequestOrigin& request) const;
  bool is_token(std::string_view text) const;

  std::string port_;
  std::vector<std::string> names_;
  bool any_number_ = false;
  std::string token_;
  std::string cookie_name_;
};

/// Whether nothing but this machine can reach what listens on `address`.
bool is_loopback(std::string_view address);

/// 32 hexadecimal digits nobody can guess.
std::string random_token();

}  // namespace maggic::studio
