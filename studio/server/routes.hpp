#pragma once
/// What answers which path.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <httplib.h>

namespace maggic::studio {

class Routes {
 public:
  /// @param name what stands for the `*` of the path; empty where there is none.
  using Handler = std::function<void(const httplib::Request& request, std::string_view name,
                                     httplib::Response& response)>;

  /// Where a path leads.
  struct Match {
    bool known = false;                ///< Whether there is anything of that path.
    const Handler* handler = nullptr;  ///< Null where it does not take the method.
    std::string name;
    std::string methods;  ///< Those it takes, for the header Allow.
  };

  /// @param method `GET`, which stands for HEAD too, `PUT` or `POST`.
  /// @param path as it is, but for one `*`, which stands for one or more characters other than `/`.
  void add(std::string method, std::string path, Handler handler);
  Match find(std::string_view method, std::string_view path) const;

 private:
  struct Route {
    std::string method;
    std::string path;
    Handler handler;
  };
  std::vector<Route> routes_;
};

}  // namespace maggic::studio
