#pragma once
/// What a user types after `--source`.

#include <string_view>

#include "maggic/document.hpp"

namespace maggic::app {

/// The source section `argument` stands for, a map of one plugin name to its parameters:
///
///     0, /dev/video0, /dev/v4l/…         camera {device}
///     synthetic                          synthetic_match
///     rtsp://…, http://…, any scheme://  video {path}
///     a folder, a pattern with * or ?,   images {path}
///       a file named like a picture
///     any other file                     video {path}
///
/// What exists under that very name is taken first, so a file may have `*` in its name.
/// @throws std::invalid_argument when there is no such file; the message lists what is accepted.
Node source_from_argument(std::string_view argument);

}  // namespace maggic::app
