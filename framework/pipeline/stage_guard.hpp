#pragma once
/// Calls into stages, with whatever they throw turned into our own exception.

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "maggic/pipeline.hpp"
#include "maggic/stage.hpp"

namespace maggic {

/// When a call happened; put into words only if it failed, so that a frame costs no formatting.
struct AtFrame {
  std::uint64_t sequence;
};
inline std::string in_words(AtFrame when) { return fmt::format("at frame {}", when.sequence); }
inline std::string in_words(std::string_view when) { return std::string(when); }

/// Runs `call`; an exception becomes a StageError that names the stage and says `when`. The
/// plugin's own exception object is destroyed before this returns, so the library that holds its
/// type information may go any time after.
template <class When, class F>
decltype(auto) guarded(StageKind kind, std::string_view name, When when, F&& call) {
  try {
    return std::forward<F>(call)();
  } catch (const std::exception& e) {
    throw StageError(fmt::format("{} '{}' failed {}: {}", name_of(kind), name,
                                 in_words(when), e.what()));
  } catch (...) {
    throw StageError(fmt::format("{} '{}' failed {}: an exception that is not a std::exception",
                                 name_of(kind), name, in_words(when)));
  }
}

/// A reporter that fails leaves nobody to tell, and is no reason to end a run.
inline void tell(Reporter& reporter, std::string_view message) noexcept {
  try {
    reporter.warn(message);
  } catch (...) {
  }
}

}  // namespace maggic
