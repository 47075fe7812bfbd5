#include "app/console.hpp"

#include <cstdlib>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/console_reporter.hpp"

namespace maggic::app {
namespace {

using ::testing::HasSubstr;

std::string printed(Console::Capabilities capabilities,
                    const std::function<void(Console&)>& print) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = ::open_memstream(&text, &size);
  {
    Console console(stream, capabilities);
    print(console);
  }
  std::fclose(stream);
  std::string result(text, size);
  std::free(text);
  return result;
}

constexpr Console::Capabilities kPlain{false, false, 80};
constexpr Console::Capabilities kTerminal{true, false, 80};
constexpr Console::Capabilities kColorTerminal{true, true, 80};

TEST(Console, WithoutATerminalTheLiveLineIsAnOrdinaryLine) {
  EXPECT_EQ(printed(kPlain,
                    [](Console& c) {
                      c.live("10 %");
                      c.line("warned");
                      c.live("20 %");
                    }),
            "10 %\nwarned\n20 %\n");
}

TEST(Console, OnATerminalTheLiveLineStaysBelowWhatIsPrinted) {
  EXPECT_EQ(printed(kTerminal,
                    [](Console& c) {
                      c.live("10 %");
                      c.line("warned");
                      c.live("20 %");
                    }),
            "10 %"
            "\r\x1b[K"
            "warned\n10 %"
            "\r\x1b[K"
            "20 %"
            "\r\x1b[K");
}

TEST(Console, ColorsThePrefixOnlyWhereColorIsWanted) {
  const auto warn = [](Console& c) { c.line("text", Console::Tone::kWarning, "warning: "); };
  EXPECT_EQ(printed(kTerminal, warn), "warning: text\n");
  EXPECT_EQ(printed(kColorTerminal, warn), "\x1b[33mwarning: \x1b[0mtext\n");
}

TEST(ConsoleReporter, PrintsARepeatedMessageOnceAndCountsIt) {
  const std::string text = printed(kPlain, [](Console& c) {
    ConsoleReporter reporter(c);
    for (int frame = 1; frame <= 25; ++frame) {
      reporter.warn("frame " + std::to_string(frame) + " is empty");
    }
    reporter.warn("another matter");
    reporter.print_totals();
  });
  EXPECT_EQ(text,
            "warning: frame 1 is empty\n"
            "warning: frame 10 is empty (10 times so far)\n"
            "warning: another matter\n"
            "warning: 25 times, latest: frame 25 is empty\n");
}

TEST(ConsoleReporter, BoundsHowManyDifferentMessagesItKeeps) {
  const std::string text = printed(kPlain, [](Console& c) {
    ConsoleReporter reporter(c);
    for (int i = 0; i < 150; ++i) reporter.warn(std::string(static_cast<std::size_t>(i + 1), 'x'));
    reporter.print_totals();
  });
  EXPECT_THAT(text, HasSubstr("50 further messages were left out"));
}

}  // namespace
}  // namespace maggic::app
