#include "app/console_reporter.hpp"

#include <fmt/format.h>

namespace maggic::app {
namespace {

constexpr std::size_t kMaxDifferentMessages = 100;  // a stage may put anything into a message

std::string without_numbers(std::string_view message) {
  std::string key;
  for (const char c : message) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit) {
      key += c;
    } else if (key.empty() || key.back() != '#') {
      key += '#';
    }
  }
  return key;
}

bool is_power_of_ten(std::uint64_t n) {
  while (n >= 10 && n % 10 == 0) n /= 10;
  return n == 1;
}

}  // namespace

void ConsoleReporter::warn(std::string_view message) {
  const std::lock_guard lock(mutex_);
  std::string key = without_numbers(message);
  auto found = messages_.find(key);
  if (found == messages_.end()) {
    if (messages_.size() == kMaxDifferentMessages) {
      ++not_kept_;
      return;
    }
    found = messages_.try_emplace(std::move(key)).first;
  }
  Repeated& repeated = found->second;
  repeated.latest = message;
  if (++repeated.count == 1) {
    console_.line(message, Console::Tone::kWarning, "warning: ");
  } else if (is_power_of_ten(repeated.count)) {
    console_.line(fmt::format("{} ({} times so far)", message, repeated.count),
                  Console::Tone::kWarning, "warning: ");
  }
}

void ConsoleReporter::print_totals() {
  const std::lock_guard lock(mutex_);
  for (const auto& [key, repeated] : messages_) {
    if (repeated.count < 2) continue;
    console_.line(fmt::format("{} times, latest: {}", repeated.count, repeated.latest),
                  Console::Tone::kWarning, "warning: ");
  }
  if (not_kept_ > 0) {
    console_.line(fmt::format("{} further messages were left out", not_kept_),
                  Console::Tone::kWarning, "warning: ");
  }
}

}  // namespace maggic::app
