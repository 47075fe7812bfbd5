#include "maggic/config_error.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace maggic {
namespace {

/// File order; files in the order they were first mentioned. A value reached through two aliases
/// is read twice, hence the removal of repetitions.
std::vector<Mistake> in_file_order(std::vector<Mistake> mistakes) {
  std::map<std::string, std::size_t> rank;
  for (const Mistake& m : mistakes) rank.try_emplace(m.file, rank.size());
  std::ranges::stable_sort(mistakes, {}, [&](const Mistake& m) {
    return std::tuple(rank.at(m.file), m.line, m.column);
  });
  const auto same = [](const Mistake& a, const Mistake& b) {
    return std::tie(a.file, a.line, a.column, a.message) ==
           std::tie(b.file, b.line, b.column, b.message);
  };
  mistakes.erase(std::unique(mistakes.begin(), mistakes.end(), same), mistakes.end());
  return mistakes;
}

std::string joined(const std::vector<Mistake>& mistakes) {
  std::string text;
  for (const Mistake& m : mistakes) {
    if (!text.empty()) text += '\n';
    text += m.to_string();
  }
  return text;
}

}  // namespace

std::string Mistake::to_string() const {
  if (line <= 0) return fmt::format("{}: {}", file, message);
  return fmt::format("{}:{}:{}: {}", file, line, column, message);
}

ConfigError::ConfigError(std::vector<Mistake> mistakes)
    : ConfigError(Sorted{in_file_order(std::move(mistakes))}) {}

ConfigError::ConfigError(Sorted sorted)
    : std::runtime_error(joined(sorted.mistakes)), mistakes_(std::move(sorted.mistakes)) {}

}  // namespace maggic
