#pragma once
/// `--why X,Y`: what became of a point of the picture, told when a run is over.

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "maggic/point_explanation.hpp"

namespace maggic::app {

class Why {
 public:
  /// @throws std::invalid_argument when a point is not two numbers.
  explicit Why(const WhyOptions& options);

  /// Takes note of what became of the points in this frame, if it is one that is asked for: the
  /// one numbered, or any, as it may be the last. To be called on the frame path's thread right
  /// after each processed frame; does nothing when no point is asked for.
  /// @param stop set when a point turns out to lie outside of the picture.
  void look(const Pipeline& pipeline, const FrameResult& result, std::atomic<bool>& stop);

  /// Prints the answers. @return kMistake when a point was outside of the picture or the frame
  /// never came, having said so on the console.
  ExitCode print(std::FILE* out, Console& console) const;

 private:
  struct Point {
    cv::Point pixel_px;
    std::vector<StageAnswer> answers;
  };

  std::vector<Point> points_;
  std::optional<std::uint64_t> wanted_frame_;
  std::optional<std::uint64_t> explained_frame_;
  std::optional<std::uint64_t> last_frame_;
  std::string mistake_;
};

}  // namespace maggic::app
