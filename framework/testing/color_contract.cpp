#include "color_contract.hpp"

#include <array>
#include <random>
#include <thread>
#include <vector>

#include "guarded.hpp"

namespace maggic::testing {
namespace {

/// Around every vector width a compiler may pick, and the tails it may forget.
constexpr std::array kBatchSizes = {0, 1, 2, 3, 7, 8, 15, 16, 17, 63, 64, 65, 255, 256, 257, 1000};
constexpr std::size_t kMaxBatch = 1000;

using Planes = std::vector<std::vector<std::uint8_t>>;

/// Random colours, among them grays, black and white; the same in every run.
Planes example_colors(std::size_t planes) {
  std::mt19937 random(7);
  Planes colors(planes, std::vector<std::uint8_t>(kMaxBatch));
  const auto random_byte = [&random] { return static_cast<std::uint8_t>(random()); };
  for (std::size_t i = 0; i < kMaxBatch; ++i) {
    const std::uint8_t gray = i == 0 ? 0 : i == 1 ? 255 : random_byte();
    for (auto& plane : colors) plane[i] = i < 2 || i % 16 == 5 ? gray : random_byte();
  }
  return colors;
}

/// One call on the colours [begin, begin + count), with every promise about memory checked.
Planes call(const ColorFunction& function, const Planes& colors, std::size_t begin,
            std::size_t count, std::uint8_t fill, Findings& findings) {
  std::vector<GuardedBytes> in_memory(colors.size(), GuardedBytes(count, 0));
  std::vector<GuardedBytes> out_memory(function.outputs, GuardedBytes(count, fill));
  std::vector<std::span<const std::uint8_t>> in;
  std::vector<std::span<std::uint8_t>> out;
  for (std::size_t p = 0; p < colors.size(); ++p) {
    std::copy_n(colors[p].begin() + static_cast<std::ptrdiff_t>(begin), count,
                in_memory[p].span().begin());
    in.push_back(in_memory[p].span());
  }
  for (GuardedBytes& memory : out_memory) out.push_back(memory.span());

  function.run(in, out);

  for (std::size_t p = 0; p < colors.size(); ++p) {
    if (!in_memory[p].intact() ||
        !std::ranges::equal(in[p], std::span(colors[p]).subspan(begin, count))) {
      findings.add("a batch of {} was written to its input, expected it to be read only", count);
    }
  }
  Planes result;
  for (GuardedBytes& memory : out_memory) {
    if (!memory.intact()) {
      findings.add("a batch of {} was written beyond its ends", count);
    }
    result.emplace_back(memory.span().begin(), memory.span().end());
  }
  return result;
}

Planes singles(const ColorFunction& function, const Planes& colors, Findings& findings) {
  Planes result(function.outputs);
  for (std::size_t i = 0; i < kMaxBatch; ++i) {
    const Planes one = call(function, colors, i, 1, 0x11, findings);
    for (std::size_t p = 0; p < one.size(); ++p) result[p].push_back(one[p][0]);
  }
  return result;
}

bool begins_with(const Planes& all, const Planes& part) {
  for (std::size_t p = 0; p < part.size(); ++p) {
    if (!std::ranges::equal(part[p], std::span(all[p]).first(part[p].size()))) return false;
  }
  return true;
}

void check_batches(const ColorFunction& function, const Planes& colors, const Planes& expected,
                   Findings& findings) {
  for (const int size : kBatchSizes) {
    const auto count = static_cast<std::size_t>(size);
    const Planes once = call(function, colors, 0, count, 0x11, findings);
    const Planes again = call(function, colors, 0, count, 0xEE, findings);
    if (once != again) {
      findings.add("a batch of {} answered differently the second time, or left answers unwritten",
                   size);
    } else if (!begins_with(expected, once)) {
      findings.add("a batch of {} differs from the same colours one at a time", size);
    }
  }
}

/// Both calls run at once; ThreadSanitizer sees what the comparison does not.
void check_two_threads(const ColorFunction& on_this, const ColorFunction& on_other,
                       const Planes& colors, const Planes& expected, std::string_view whose,
                       Findings& findings) {
  constexpr int kRounds = 20;
  const auto rounds = [&](const ColorFunction& function, bool& agrees, Findings& into) {
    for (int round = 0; round < kRounds; ++round) {
      agrees = agrees && call(function, colors, 0, kMaxBatch, 0x11, into) == expected;
    }
  };
  bool agrees_here = true;
  bool agrees_there = true;
  Findings unused;  // the other thread's memory findings were made on this thread already
  std::thread other([&] { runs(unused, "", [&] { rounds(on_other, agrees_there, unused); }); });
  const bool ran = runs(findings, "a call beside another thread",
                        [&] { rounds(on_this, agrees_here, findings); });
  other.join();
  if (ran && !(agrees_here && agrees_there)) {
    findings.add("{} on two threads disagree with one thread", whose);
  }
}

}  // namespace

void check_color_function(const ColorFunction& first, const ColorFunction& second,
                          Findings& findings) {
  const Planes colors = example_colors(first.inputs);
  runs(findings, "a batch", [&] {
    const Planes expected = singles(first, colors, findings);
    for (const auto& plane : expected) {
      for (const std::uint8_t value : plane) {
        if (value >= first.values) {
          findings.add("label {} was written, expected labels below the palette's size {}", value,
                       first.values);
        }
      }
    }
    check_batches(first, colors, expected, findings);
    check_two_threads(first, second, colors, expected, "two instances", findings);
    check_two_threads(first, first, colors, expected, "two calls of one instance", findings);
  });
}

}  // namespace maggic::testing
