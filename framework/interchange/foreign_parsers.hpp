#pragma once
/// One parser a kind of file. All throw ConfigError.

#include <string_view>

#include "maggic/foreign_calibration.hpp"

namespace maggic {

MaggicSession parse_maggic_session(std::string_view text, std::string_view file_name);
YuvBoxFile parse_yuv_box_file(std::string_view text, std::string_view file_name);
FieldLimits parse_field_limits(std::string_view text, std::string_view file_name);

}  // namespace maggic
