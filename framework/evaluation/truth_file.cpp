#include "maggic/truth_file.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "config/wording.hpp"
#include "evaluation/json_text.hpp"
#include "field/corners.hpp"

namespace maggic {
namespace {

using Json = nlohmann::json;

constexpr double kMaxMagnitude = 1e6;  // of a coordinate or an angle, in any unit
constexpr double kMaxSide = 65535.0;
constexpr std::uint64_t kMaxFrame = std::uint64_t{1} << 53;  // what a JSON number holds exactly

std::string found_text(const Json& value) {
  if (value.is_null()) return "nothing";
  if (value.is_string()) return quoted_excerpt(value.get_ref<const std::string&>());
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  return value.dump();
}

/// A value and where it stands in its file.
class Value {
 public:
  Value(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  const Json& json() const { return *json_; }
  const std::string& path() const { return path_; }
  /// What stands under `key`; null where nothing does.
  Value at(const char* key) const {
    static const Json nothing;
    const bool has = json_->is_object() && json_->contains(key);
    return {has ? (*json_)[key] : nothing, path_ + '/' + key};
  }
  Value at(std::size_t index) const {
    return {(*json_)[index], path_ + '/' + std::to_string(index)};
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }

 private:
  const Json* json_;
  std::string path_;
};

/// Reads one file's tree, noting every mistake on the way.
class Reader {
 public:
  Reader(std::string_view file_name, const Palette& palette)
      : file_name_(file_name), palette_(palette) {}

  Truth read(const Json& json) {
    const Value root(json, "");
    Truth truth;
    if (!json.is_object()) {
      note(root, "an object with size_px, tolerance_px, ball and robots (or frames)");
    } else {
      truth.media = read_text(root, "media");
      truth.size_px = read_size(root.at("size_px"));
      truth.tolerance = read_tolerance(root);
      if (root.has("field_corners_px")) {
        truth.field_corners_px = read_corners(root.at("field_corners_px"));
      }
      if (root.has("frames")) {
        read_frames(root.at("frames"), truth);
      } else {
        truth.every_frame = read_scene(root);
      }
    }
    if (!mistakes_.empty()) throw ConfigError(std::move(mistakes_));
    return truth;
  }

 private:
  void note_sentence(const std::string& path, const std::string& sentence) {
    // A file of another kind would repeat itself for every object.
    constexpr std::size_t kEnough = 20;
    if (mistakes_.size() >= kEnough) return;
    mistakes_.push_back(
        {file_name_, 0, 0, path.empty() ? sentence : fmt::format("{}: {}", path, sentence)});
  }
  void note(const Value& value, std::string_view expected) {
    note_sentence(value.path(),
                  fmt::format("found {}, expected {}", found_text(value.json()), expected));
  }

  std::string read_text(const Value& object, const char* key) {
    if (!object.has(key)) return {};
    const Value value = object.at(key);
    if (value.json().is_string()) return value.json().get<std::string>();
    note(value, "text");
    return {};
  }

  std::optional<double> read_number(const Value& value, double min, double max,
                                    std::string_view expected) {
    if (value.json().is_number()) {
      const double number = value.json().get<double>();
      if (number >= min && number <= max) return number;
    }
    note(value, expected);
    return std::nullopt;
  }

  std::optional<double> read_coordinate(const Value& value) {
    return read_number(value, -kMaxMagnitude, kMaxMagnitude, "a number from -1e6 to 1e6");
  }

  /// `[a, b]`.
  std::optional<cv::Point2d> read_pair(const Value& value, double min, double max,
                                       std::string_view expected) {
    if (!value.json().is_array() || value.json().size() != 2) {
      note(value, expected);
      return std::nullopt;
    }
    const auto a = read_number(value.at(std::size_t{0}), min, max, expected);
    const auto b = read_number(value.at(std::size_t{1}), min, max, expected);
    if (!a || !b) return std::nullopt;
    return cv::Point2d(*a, *b);
  }

  cv::Size read_size(const Value& value) {
    constexpr std::string_view kExpected =
        "the picture's width and height in pixels, two whole numbers from 1 to 65535";
    const auto size = read_pair(value, 1.0, kMaxSide, kExpected);
    if (!size) return {};
    if (size->x != std::floor(size->x) || size->y != std::floor(size->y)) {
      note(value, kExpected);
      return {};
    }
    return {static_cast<int>(size->x), static_cast<int>(size->y)};
  }

  Tolerance read_tolerance(const Value& root) {
    if (root.has("tolerance_px") == root.has("tolerance_mm")) {
      note_sentence("", fmt::format("found {} tolerance_px and tolerance_mm, expected one of them",
                                    root.has("tolerance_px") ? "both" : "neither"));
      return {};
    }
    const bool in_pixels = root.has("tolerance_px");
    const auto distance = read_number(root.at(in_pixels ? "tolerance_px" : "tolerance_mm"), 1e-3,
                                      kMaxSide, "a number from 0.001 to 65535");
    return {distance.value_or(1.0),
            in_pixels ? Tolerance::Unit::kPixels : Tolerance::Unit::kMillimeters};
  }

  std::vector<cv::Point2d> read_corners(const Value& value) {
    constexpr std::string_view kExpected = "four corners, [x, y] in pixels each";
    if (!value.json().is_array() || value.json().size() != 4) {
      note(value, kExpected);
      return {};
    }
    std::vector<cv::Point2d> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto corner = read_pair(value.at(i), -kMaxMagnitude, kMaxMagnitude, "[x, y] in pixels");
      if (!corner) return {};
      corners.push_back(*corner);
    }
    const std::string mistake = mistake_in_corners(corners);
    if (!mistake.empty()) note_sentence(value.path(), mistake);
    return corners;
  }

  void read_frames(const Value& frames, Truth& truth) {
    if (!frames.json().is_array()) return note(frames, "a list of frames");
    for (std::size_t i = 0; i < frames.json().size(); ++i) {
      const Value frame = frames.at(i);
      if (!frame.json().is_object()) {
        note(frame, "an object with frame, ball and robots");
        continue;
      }
      const Value number = frame.at("frame");
      const bool is_index =
          number.json().is_number_unsigned() && number.json().get<std::uint64_t>() <= kMaxFrame;
      if (!is_index) {
        note(number, "the frame's number, counted from 0");
        continue;
      }
      const auto sequence = number.json().get<std::uint64_t>();
      if (!truth.frames.try_emplace(sequence, read_scene(frame)).second) {
        note_sentence(number.path(), fmt::format("frame {} is listed twice", sequence));
      }
    }
  }

  TrueScene read_scene(const Value& object) {
    TrueScene scene;
    if (!object.has("ball")) {
      note(object.at("ball"), "the ball, or null where there is none");
    } else if (!object.at("ball").json().is_null()) {
      scene.ball = read_ball(object.at("ball"));
    }
    const Value robots = object.at("robots");
    if (!robots.json().is_array()) {
      note(robots, "a list of robots");
      return scene;
    }
    if (robots.json().size() > kMaxTrueRobots) {
      note_sentence(robots.path(), fmt::format("found {} robots in one frame, expected at most {}",
                                               robots.json().size(), kMaxTrueRobots));
      return scene;
    }
    for (std::size_t i = 0; i < robots.json().size(); ++i) {
      scene.robots.push_back(read_robot(robots.at(i)));
    }
    return scene;
  }

  std::optional<cv::Point2d> read_point(const Value& object, const char* x_key, const char* y_key) {
    if (!object.has(x_key) && !object.has(y_key)) return std::nullopt;
    const auto x = read_coordinate(object.at(x_key));
    const auto y = read_coordinate(object.at(y_key));
    if (!x || !y) return cv::Point2d();  // noted; a place stands in, so that it is not noted twice
    return cv::Point2d(*x, *y);
  }

  template <class Object>
  void read_place(const Value& value, Object& object) {
    object.centroid_px = read_point(value, "x", "y");
    if (!object.centroid_px) object.centroid_px = read_point(value, "x_px", "y_px");
    object.position_mm = read_point(value, "x_mm", "y_mm");
    if (object.centroid_px || object.position_mm) return;
    note_sentence(value.path(), "has no place, expected x and y (pixels) or x_mm and y_mm (field)");
  }

  TrueBall read_ball(const Value& value) {
    TrueBall ball;
    if (value.json().is_object()) {
      read_place(value, ball);
    } else {
      note(value, "an object with x and y, or null");
    }
    return ball;
  }

  TrueRobot read_robot(const Value& value) {
    TrueRobot robot;
    if (!value.json().is_object()) {
      note(value, "an object with team, x and y");
      return robot;
    }
    read_place(value, robot);
    robot.identity.team = read_team(value.at("team"));
    robot.identity.id = read_id(value);
    for (const Label label : read_colors(value)) robot.identity.player_colors.push_back(label);
    read_heading(value, robot);
    robot.tags = read_tags(value);
    return robot;
  }

  Team read_team(const Value& value) {
    for (const Team team : {Team::kBlue, Team::kYellow}) {
      if (value.json() == name_of(team)) return team;
    }
    note(value, "blue or yellow");
    return Team::kBlue;
  }

  std::optional<int> read_id(const Value& robot) {
    if (!robot.has("id")) return std::nullopt;
    const Value value = robot.at("id");
    constexpr int kMaxId = 1'000'000;
    if (value.json().is_number_integer()) {
      const auto id = read_number(value, kUnknownId, kMaxId, "a whole number from -1 to 1000000");
      if (!id || *id == kUnknownId) return std::nullopt;
      return static_cast<int>(*id);
    }
    note(value, "a whole number from -1 to 1000000");
    return std::nullopt;
  }

  std::vector<Label> read_colors(const Value& robot) {
    std::vector<Label> labels;
    if (!robot.has("player_colors")) return labels;
    const Value colors = robot.at("player_colors");
    if (!colors.json().is_array() || colors.json().size() >= kMaxPatches) {
      note(colors, fmt::format("a list of at most {} colours", kMaxPatches - 1));
      return labels;
    }
    for (std::size_t i = 0; i < colors.json().size(); ++i) {
      labels.push_back(read_color(colors.at(i)));
    }
    return labels;
  }

  Label read_color(const Value& value) {
    if (value.json().is_string()) {
      const auto label = palette_.find(value.json().get_ref<const std::string&>());
      if (label && *label != kBackground) return *label;
    }
    note(value, fmt::format("a colour of the palette (known: {})", palette_.known_names()));
    return kBackground;
  }

  void read_heading(const Value& value, TrueRobot& robot) {
    if (value.has("heading_rad")) robot.heading_rad = read_coordinate(value.at("heading_rad"));
    if (!value.has("heading_deg")) return;
    if (const auto degrees = read_coordinate(value.at("heading_deg"))) {
      // It points from the player tags to the team tag; the front is the player tags' side.
      robot.picture_heading_rad = (*degrees + 180.0) * std::numbers::pi / 180.0;
    }
  }

  std::vector<TrueTag> read_tags(const Value& robot) {
    std::vector<TrueTag> tags;
    if (!robot.has("tags")) return tags;
    const Value list = robot.at("tags");
    if (!list.json().is_array() || list.json().size() > kMaxPatches) {
      note(list, fmt::format("a list of at most {} tags", kMaxPatches));
      return tags;
    }
    for (std::size_t i = 0; i < list.json().size(); ++i) {
      const Value tag = list.at(i);
      const auto centroid_px = read_point(tag, "x", "y");
      if (!centroid_px) {
        note(tag, "an object with color, x and y");
        continue;
      }
      tags.push_back({read_color(tag.at("color")), *centroid_px});
    }
    return tags;
  }

  std::string file_name_;
  const Palette& palette_;
  std::vector<Mistake> mistakes_;
};

}  // namespace

const TrueScene* Truth::at(std::uint64_t sequence) const {
  if (every_frame) return &*every_frame;
  const auto found = frames.find(sequence);
  return found == frames.end() ? nullptr : &found->second;
}

Truth parse_truth(std::string_view text, std::string_view file_name, const Palette& palette) {
  return Reader(file_name, palette).read(parse_json(text, file_name));
}

Truth load_truth(const std::filesystem::path& file, const Palette& palette) {
  const auto fail = [&](std::string message) {
    throw ConfigError({{file.string(), 0, 0, std::move(message)}});
  };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail("no such file");
  if (std::filesystem::is_directory(file, error)) fail("found a folder, expected a JSON file");
  std::ifstream stream(file, std::ios::binary);
  // Read piece by piece: a device or a pipe has no size to ask for.
  std::string text;
  std::array<char, 65536> piece;
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxTruthBytes) {
      fail(fmt::format("found more than {} bytes, expected a truth file", kMaxTruthBytes));
    }
  }
  if (!stream.eof()) fail("cannot be read");
  return parse_truth(text, file.string(), palette);
}

}  // namespace maggic
