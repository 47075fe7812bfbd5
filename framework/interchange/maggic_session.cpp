/// MaggicSegmentation.txt, as RoboCIn's vss-vision saves and loads it: words between blanks, in a
/// fixed order.

#include <fmt/format.h>

#include "config/wording.hpp"
#include "interchange/foreign_parsers.hpp"
#include "interchange/text_cursor.hpp"

namespace maggic {
namespace {

constexpr std::size_t kMaxPivots = 1000;

PlacedNumber take_number(TextCursor& cursor, int min, int max, std::string_view what) {
  cursor.skip_blanks();
  const Place place = cursor.place();
  return {number_in_range(cursor.take_word(), place, min, max, what), place};
}

}  // namespace

MaggicSession parse_maggic_session(std::string_view text, std::string_view file_name) {
  TextCursor cursor(text, file_name);
  cursor.skip_blanks();
  MaggicSession session;
  session.place = cursor.place();
  if (const std::string_view word = cursor.take_word(); word != "Maggic") {
    throw ConfigError({mistake_at(
        session.place, fmt::format("found {}, expected the word Maggic", quoted_excerpt(word)))});
  }
  // The range their search for a threshold keeps to; nothing of ours.
  take_number(cursor, 0, 255, "the lowest gray threshold to try, from 0 to 255");
  take_number(cursor, 0, 255, "the highest gray threshold to try, from 0 to 255");
  session.gray_threshold = take_number(cursor, 0, 255, "a gray threshold from 0 to 255");
  for (cursor.skip_blanks(); !cursor.at_end(); cursor.skip_blanks()) {
    if (session.pivots.size() == kMaxPivots) {
      throw ConfigError({mistake_at(cursor.place(),
                                    fmt::format("found more than {} lines of hues", kMaxPivots))});
    }
    MaggicSession::Pivot pivot;
    pivot.hue = take_number(cursor, -1, 255, "a hue from -1 to 255");
    pivot.label = take_number(
        cursor, 1, 9,
        "the hue's label: 1 orange, 2 blue, 3 yellow, 4 red, 5 green, 6 pink, 7 light blue, "
        "8 purple, 9 brown");
    session.pivots.push_back(pivot);
  }
  if (session.pivots.empty()) {
    throw ConfigError({mistake_at(cursor.place(), "found no hues, expected lines 'hue label'")});
  }
  return session;
}

}  // namespace maggic
