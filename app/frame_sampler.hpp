#pragma once
/// A few frames of a source, spread over all that was looked at.

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "app/console.hpp"
#include "maggic/source.hpp"

namespace maggic::app {

/// Opens `source`, reads up to `most` frames and keeps at most 24 of them, evenly spread, as
/// CV_8UC3. Frames of another size than the first, or that are no pictures, are passed over.
/// @throws what the source throws; std::runtime_error when nothing comes for 10 seconds.
std::vector<cv::Mat> sample_frames(Source& source, std::uint64_t most, Console& console);

}  // namespace maggic::app
