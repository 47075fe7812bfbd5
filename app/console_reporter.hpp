#pragma once
/// Tells the user what stages report, without flooding the screen.

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "app/console.hpp"
#include "maggic/stage.hpp"

namespace maggic::app {

/// Prints a message when it comes first, and again at its 10th, 100th, … time with the count.
/// Messages that differ in numbers only (a frame number, say) count as the same.
class ConsoleReporter final : public Reporter {
 public:
  explicit ConsoleReporter(Console& console) : console_(console) {}

  void warn(std::string_view message) override;

  /// Tells how often each repeated message came in all. Call once, at the end.
  void print_totals();

 private:
  struct Repeated {
    std::string latest;
    std::uint64_t count = 0;
  };

  Console& console_;
  std::mutex mutex_;
  std::map<std::string, Repeated, std::less<>> messages_;
  std::uint64_t not_kept_ = 0;
};

}  // namespace maggic::app
