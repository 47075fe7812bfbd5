#include "maggic/foreign_calibration.hpp"

#include <fmt/format.h>

#include "config/wording.hpp"
#include "files/text_file.hpp"
#include "interchange/foreign_parsers.hpp"
#include "interchange/text_cursor.hpp"

namespace maggic {

ForeignCalibration parse_foreign_calibration(std::string_view text, std::string_view file_name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  TextCursor cursor(text, file_name);
  cursor.skip_blanks();
  if (cursor.rest().starts_with('<')) return parse_yuv_box_file(text, file_name);
  if (cursor.rest().starts_with('{')) return parse_field_limits(text, file_name);
  const Place place = cursor.place();
  const std::string_view word = cursor.take_word();
  if (word == "Maggic") return parse_maggic_session(text, file_name);
  throw ConfigError({mistake_at(
      place, fmt::format("found {}, expected the start of MaggicSegmentation.txt ('Maggic'), of "
                         "YUV boxes ('<?xml …>') or of fieldLimits.json ('{{')",
                         word.empty() ? "nothing" : quoted_excerpt(word)))});
}

ForeignCalibration load_foreign_calibration(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
  const std::string text = read_text_file(file, kMaxBytes, "calibration of another program");
  return parse_foreign_calibration(text, file.string());
}

}  // namespace maggic
