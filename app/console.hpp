#pragma once
/// A text stream that may be a terminal: whole lines, and one live line that is rewritten.

#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace maggic::app {

/// Thread-safe. On a terminal the live line stays below everything printed with `line`; elsewhere
/// it is an ordinary line.
class Console {
 public:
  enum class Tone { kPlain, kWarning, kError };

  /// What is known of the stream; taken from the system unless a test says otherwise.
  struct Capabilities {
    bool terminal = false;
    bool color = false;
    std::optional<int> width;  ///< Fixed width in columns; empty: asked of the terminal each time.
  };

  /// @param stream not owned.
  explicit Console(std::FILE* stream);
  Console(std::FILE* stream, Capabilities capabilities);
  /// Ends the live line.
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool is_terminal() const { return capabilities_.terminal; }
  /// Columns of a line; wide when there is no terminal to fit into.
  int width() const;

  /// Prints a line. @param prefix is coloured by `tone`, such as "warning: ".
  void line(std::string_view text, Tone tone = Tone::kPlain, std::string_view prefix = {});
  /// Replaces the live line; `text` must fit into `width()`.
  void live(std::string_view text);
  /// Removes the live line.
  void end_live();

 private:
  void erase_live();

  std::FILE* stream_;
  Capabilities capabilities_;
  std::mutex mutex_;
  std::string live_;
};

}  // namespace maggic::app
