#pragma once
/// Mistakes in configuration files, with their places.

#include <stdexcept>
#include <string>
#include <vector>

namespace maggic {

/// One mistake (or warning) at one place of a file.
struct Mistake {
  std::string file;     ///< As the user named it; `--set` for a command-line override.
  int line = 0;         ///< From 1; 0 when the mistake is the file as a whole.
  int column = 0;       ///< From 1, in characters of the line.
  std::string message;  ///< What was found, what was expected.

  /// "file:line:col: message", or "file: message" without a place.
  std::string to_string() const;
};

/// Every mistake found in one reading, in file order, each once.
class ConfigError : public std::runtime_error {
 public:
  /// @param mistakes at least one, in any order. `what()` is one line each.
  explicit ConfigError(std::vector<Mistake> mistakes);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }

 private:
  struct Sorted {
    std::vector<Mistake> mistakes;
  };
  explicit ConfigError(Sorted sorted);

  std::vector<Mistake> mistakes_;
};

}  // namespace maggic
