#include "app/console.hpp"

#include <cstdlib>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace maggic::app {
namespace {

constexpr int kUsualWidth = 80;
constexpr int kUnlimitedWidth = 200;
constexpr std::string_view kEraseLine = "\r\x1b[K";

Console::Capabilities capabilities_of(std::FILE* stream) {
  const char* term = std::getenv("TERM");
  const bool dumb = term == nullptr || std::string_view(term) == "dumb" || *term == '\0';
  const bool terminal = ::isatty(::fileno(stream)) == 1 && !dumb;
  // https://no-color.org: any value but the empty one.
  const char* no_color = std::getenv("NO_COLOR");
  const bool color = terminal && (no_color == nullptr || *no_color == '\0');
  return {terminal, color, std::nullopt};
}

}  // namespace

Console::Console(std::FILE* stream) : Console(stream, capabilities_of(stream)) {}

Console::Console(std::FILE* stream, Capabilities capabilities)
    : stream_(stream), capabilities_(capabilities) {}

Console::~Console() { end_live(); }

int Console::width() const {
  if (capabilities_.width) return *capabilities_.width;
  if (!capabilities_.terminal) return kUnlimitedWidth;
  winsize size{};
  if (::ioctl(::fileno(stream_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return kUsualWidth;
}

void Console::line(std::string_view text, Tone tone, std::string_view prefix) {
  std::string_view start;
  if (capabilities_.color && tone == Tone::kWarning) start = "\x1b[33m";
  if (capabilities_.color && tone == Tone::kError) start = "\x1b[31m";
  const std::string_view end = start.empty() ? "" : "\x1b[0m";
  const std::lock_guard lock(mutex_);
  erase_live();
  // The line and the live line below it go out in one piece: what others write to the same
  // terminal comes before or after, not between.
  const std::string out = fmt::format("{}{}{}{}\n{}", start, prefix, end, text, live_);
  std::fwrite(out.data(), 1, out.size(), stream_);
  std::fflush(stream_);
}

void Console::live(std::string_view text) {
  if (!capabilities_.terminal) {
    line(text);
    return;
  }
  const std::lock_guard lock(mutex_);
  erase_live();
  live_ = text;
  std::fwrite(live_.data(), 1, live_.size(), stream_);
  std::fflush(stream_);
}

void Console::end_live() {
  const std::lock_guard lock(mutex_);
  erase_live();
  live_.clear();
  std::fflush(stream_);
}

void Console::erase_live() {
  if (!live_.empty()) std::fwrite(kEraseLine.data(), 1, kEraseLine.size(), stream_);
}

}  // namespace maggic::app
