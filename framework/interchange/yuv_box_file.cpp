/// The XML of the legacy boxes. OpenCV's own reader takes any XML, and throws or asserts on much of
/// it; this one takes the one shape these files have, and nothing else.

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/wording.hpp"
#include "interchange/foreign_parsers.hpp"
#include "interchange/text_cursor.hpp"

namespace maggic {
namespace {

const std::vector<std::string>& known_nodes() {
  static const std::vector<std::string> names{"NoCOL",  "Orange", "Blue",         "Yellow",
                                              "Red",    "Green",  "Pink",         "LightBlue",
                                              "Purple", "Brown",  "ColorStrange", "GrayScale"};
  return names;
}

const std::vector<std::string>& known_limits() {
  static const std::vector<std::string> names{"YMIN", "UMIN", "VMIN", "YMAX", "UMAX", "VMAX"};
  return names;
}

class Parser {
 public:
  Parser(std::string_view text, std::string_view file_name) : cursor_(text, file_name) {}

  YuvBoxFile parse() {
    skip_declaration();
    YuvBoxFile file;
    skip_comments();
    file.place = cursor_.place();
    const std::string root = take_open_tag();
    if (root != kRoot) {
      fail(file.place,
           fmt::format("found <{}>, expected <{}> with a box for every colour", root, kRoot));
    }
    std::map<std::string, Place> seen;
    while (!at_close_tag()) {
      const Place place = cursor_.place();
      const std::string name = take_open_tag();
      if (std::ranges::find(known_nodes(), name) == known_nodes().end()) {
        fail(place, unknown_name_message("element", name, known_nodes()));
      }
      refuse_second(seen, name, place);
      if (name == "GrayScale") {
        file.gray_scale = take_number(0, 256, "a difference of channels from 0 to 256");
        take_close_tag(name);
      } else {
        file.boxes.push_back(take_box(name, place));
      }
    }
    take_close_tag(std::string(kRoot));
    skip_comments();
    if (!cursor_.at_end()) {
      fail(cursor_.place(), fmt::format("found {} behind </{}>, expected the end of the file",
                                        quoted_excerpt(cursor_.rest()), kRoot));
    }
    if (file.boxes.empty()) fail(file.place, "found no box, expected one for every colour");
    return file;
  }

 private:
  static constexpr std::string_view kRoot = "opencv_storage";

  [[noreturn]] static void fail(const Place& place, std::string message) {
    throw ConfigError({mistake_at(place, std::move(message))});
  }

  static void refuse_second(std::map<std::string, Place>& seen, const std::string& name,
                            const Place& place) {
    const auto [first, is_new] = seen.emplace(name, place);
    if (is_new) return;
    fail(place, fmt::format("found a second <{}>, the first is in line {}, expected one", name,
                            first->second.line));
  }

  void skip_declaration() {
    cursor_.skip_blanks();
    if (!cursor_.rest().starts_with("<?xml")) return;
    skip_past("?>", "the declaration <?xml …?>");
  }

  void skip_comments() {
    for (cursor_.skip_blanks(); cursor_.rest().starts_with("<!--"); cursor_.skip_blanks()) {
      skip_past("-->", "the comment <!-- …-->");
    }
  }

  void skip_past(std::string_view end, std::string_view what) {
    const std::size_t found = cursor_.rest().find(end);
    if (found == std::string_view::npos) {
      fail(cursor_.place(), fmt::format("found no '{}' that ends {}", end, what));
    }
    cursor_.skip(found + end.size());
  }

  bool at_close_tag() {
    skip_comments();
    return cursor_.rest().starts_with("</");
  }

  /// What stands at the cursor, for messages.
  std::string found_here() const {
    if (cursor_.at_end()) return "the end of the file";
    const std::string_view rest = cursor_.rest();
    return quoted_excerpt(rest.substr(0, rest.find_first_of("\r\n")));
  }

  std::string take_open_tag() {
    skip_comments();
    const Place place = cursor_.place();
    if (!cursor_.rest().starts_with('<') || cursor_.rest().starts_with("</")) {
      fail(place, fmt::format("found {}, expected an element such as <Orange>", found_here()));
    }
    const std::string found = found_here();
    cursor_.skip(1);
    std::string name(cursor_.take_until("<>/ \t\r\n"));
    if (name.empty() || !cursor_.rest().starts_with('>')) {
      fail(place, fmt::format("found {}, expected an element without attributes, such as <Orange>",
                              found));
    }
    cursor_.skip(1);
    return name;
  }

  void take_close_tag(const std::string& name) {
    skip_comments();
    const std::string expected = "</" + name + ">";
    if (!cursor_.rest().starts_with(expected)) {
      fail(cursor_.place(), fmt::format("found {}, expected {}", found_here(), expected));
    }
    cursor_.skip(expected.size());
  }

  PlacedNumber take_number(int min, int max, std::string_view what) {
    cursor_.skip_blanks();
    const Place place = cursor_.place();
    std::string_view text = cursor_.take_until("<");
    text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    return {number_in_range(text, place, min, max, what), place};
  }

  YuvBoxFile::Box take_box(const std::string& name, const Place& place) {
    YuvBoxFile::Box box{name, place, {}, {}};
    std::map<std::string, Place> seen;
    while (!at_close_tag()) {
      const Place limit_place = cursor_.place();
      const std::string limit = take_open_tag();
      const auto known = std::ranges::find(known_limits(), limit);
      if (known == known_limits().end()) {
        fail(limit_place, unknown_name_message("element", limit, known_limits()));
      }
      refuse_second(seen, limit, limit_place);
      const auto index = static_cast<std::size_t>(known - known_limits().begin());
      (index < 3 ? box.min : box.max)[index % 3] =
          take_number(0, 255, "a whole number from 0 to 255").value;
      take_close_tag(limit);
    }
    take_close_tag(name);
    if (seen.size() != known_limits().size()) {
      fail(place, fmt::format("found {} of the six limits of {}, expected {}", seen.size(), name,
                              fmt::join(known_limits(), ", ")));
    }
    return box;
  }

  TextCursor cursor_;
};

}  // namespace

YuvBoxFile parse_yuv_box_file(std::string_view text, std::string_view file_name) {
  return Parser(text, file_name).parse();
}

}  // namespace maggic
