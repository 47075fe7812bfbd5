#pragma once
/// Keeps what OpenCV and FFmpeg write to the terminal off the program's live line.

#include <cstdlib>

#include <opencv2/core/utils/logger.hpp>

namespace maggic::live {

/// Called before a device or file is opened. Nothing is lost: what fails is told by return values,
/// and the variables OPENCV_LOG_LEVEL and OPENCV_FFMPEG_LOGLEVEL, where set, keep their say.
/// Also has V4L2 wait one second for a picture rather than ten, for the same reason of manners.
inline void quiet_video_libraries() {
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET
  ::setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "1", 0);
  if (std::getenv("OPENCV_LOG_LEVEL") == nullptr) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  }
}

}  // namespace maggic::live
