#pragma once
/// What `--truth` asks for: a file, or what the source itself knows.

#include <filesystem>
#include <optional>
#include <string>

#include "maggic/frame.hpp"
#include "maggic/palette.hpp"
#include "maggic/truth_file.hpp"

namespace maggic::app {

/// What frames are compared with.
class TruthOption {
 public:
  /// @param file left out: the source's own truth.
  /// @param palette outlives this. @throws ConfigError with every mistake in the file.
  TruthOption(std::optional<std::filesystem::path> file, const Palette& palette);

  const std::optional<Truth>& file() const { return truth_; }
  Tolerance tolerance() const { return truth_ ? truth_->tolerance : Tolerance{}; }

  /// What is in the frame; null where nobody knows. Valid until the next call.
  /// @throws ConfigError when the frame is not of the size the file is for.
  const TrueScene* scene_in(const Frame& frame);

  /// A sentence when the file names another recording than `source`, a path or URL; else empty.
  std::string doubt_about(const std::optional<std::string>& source) const;

 private:
  std::optional<std::filesystem::path> file_;
  std::optional<Truth> truth_;
  TrueScene of_source_;
};

}  // namespace maggic::app
