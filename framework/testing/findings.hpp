#pragma once
/// The broken promises found so far, one sentence each.

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace maggic::testing {

class Findings {
 public:
  /// Notes a sentence; one that was noted before is kept once.
  template <class... Args>
  void add(fmt::format_string<Args...> sentence, Args&&... args) {
    std::string text = fmt::format(sentence, std::forward<Args>(args)...);
    if (std::ranges::find(sentences_, text) == sentences_.end()) {
      sentences_.push_back(std::move(text));
    }
  }

  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::vector<std::string> sentences_;
};

/// Runs `work`; what it throws becomes a sentence. @return whether it threw nothing.
template <class Work>
bool runs(Findings& findings, std::string_view what, Work&& work) {
  try {
    work();
    return true;
  } catch (const std::exception& error) {
    findings.add("{} threw: {}", what, error.what());
  } catch (...) {
    findings.add("{} threw something that is no std::exception", what);
  }
  return false;
}

}  // namespace maggic::testing
