#include "maggic/parameter_reader.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "config/number_text.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::StartsWith;

enum class Shape { kSquare, kDisc };

struct Patch {
  std::string name;
  std::optional<double> size_mm;
};

/// One parameter of every type.
struct Settings {
  bool enabled = false;
  int gray_threshold = 40;
  double gain = 1.5;
  std::string path = "out";
  Label ball = 1;
  std::array<double, 2> span{0, 255};
  cv::Point2d offset{1, 2};
  std::optional<int> limit;
  std::optional<double> height;
  std::optional<cv::Point2d> center;
  Shape shape = Shape::kDisc;
  double inner = 0.5;
  std::vector<int> pivots{1, 2};
  std::vector<Patch> patches;
  std::vector<std::pair<Label, std::array<double, 2>>> boxes;

  void describe(Parameters& p) {
    p.boolean({"enabled", "whether it works"}, enabled);
    p.integer({"gray_threshold", "largest channel spread taken for gray", "8-bit steps"},
              gray_threshold, {0, 255});
    p.number({"gain", "factor"}, gain, {0.0, std::numeric_limits<double>::max()});
    p.text({"path", "where to"}, path);
    p.color({"ball", "the ball's colour"}, ball);
    p.numbers({"span", "from and to"}, span, {0, 255});
    p.point({"offset", "shift", "px"}, offset, {-10, 10});
    p.integer({"limit", "at most"}, limit, {1, 9});
    p.number({"height", "above the floor", "mm"}, height, {0, 100});
    p.point({"center", "in the picture", "px"}, center, {0, 1000});
    p.choice<Shape>({"shape", "of the patch"}, shape,
                    {{"square", Shape::kSquare}, {"disc", Shape::kDisc}});
    p.group({"group", "members below"}, [&](Parameters& g) {
      g.number({"inner", "in the group"}, inner, {0, 1});
    });
    p.list({"pivots", "hues"}, pivots, {1, 3}, [](Parameters& e, int& hue) {
      e.integer({"", "hue", "1/256 turn"}, hue, {0, 255});
    });
    p.list({"patches", "of the tag"}, patches, {0, 8}, [](Parameters& e, Patch& patch) {
      e.text({"name", "what it is called", "", Presence::kRequired}, patch.name);
      e.number({"size_mm", "edge", "mm"}, patch.size_mm, {1, 100});
    });
    p.by_color({"boxes", "per colour"}, boxes, {0, 2}, [](Parameters& e, auto& box) {
      e.numbers({"y", "luma"}, box, {0, 255});
      e.check("y", box[0] <= box[1], "found a minimum above the maximum, expected min, max");
    });
  }
};

std::vector<std::string> read(std::string_view yaml, const Describe& describe) {
  std::vector<Mistake> mistakes;
  const Palette palette = Palette::standard();
  read_parameters(parse_document(yaml, "f.yaml"), palette, describe, mistakes);
  std::vector<std::string> told;
  if (mistakes.empty()) return told;
  const ConfigError error(mistakes);
  for (const Mistake& m : error.mistakes()) told.push_back(m.to_string());
  return told;
}

std::vector<std::string> read(std::string_view yaml, Settings& settings) {
  return read(yaml, [&](Parameters& p) { settings.describe(p); });
}

TEST(ReadParameters, TakeTheirValuesFromTheFile) {
  Settings s;
  EXPECT_THAT(read("enabled: true\n"
                   "gray_threshold: 0xFF\n"
                   "gain: +1e-3\n"
                   "path: 12\n"
                   "ball: 'cyan'\n"
                   "span: [10, 20.5]\n"
                   "offset: [-1, .5]\n"
                   "limit: 3\n"
                   "height: 21.35\n"
                   "center: [320, 240]\n"
                   "shape: square\n"
                   "group: {inner: 1}\n"
                   "pivots: [250, 3]\n"
                   "patches: [{name: left, size_mm: 20}, {name: right}]\n"
                   "boxes: {red: {y: [1, 2]}, blue: {y: [3, 4]}}\n",
                   s),
              IsEmpty());
  EXPECT_TRUE(s.enabled);
  EXPECT_EQ(s.gray_threshold, 255);
  EXPECT_EQ(s.gain, 1e-3);
  EXPECT_EQ(s.path, "12");
  EXPECT_EQ(Palette::standard().name(s.ball), "cyan");
  EXPECT_THAT(s.span, ElementsAre(10, 20.5));
  EXPECT_EQ(s.offset, cv::Point2d(-1, 0.5));
  EXPECT_EQ(s.limit, 3);
  EXPECT_EQ(s.height, 21.35);
  EXPECT_EQ(s.center, cv::Point2d(320, 240));
  EXPECT_EQ(s.shape, Shape::kSquare);
  EXPECT_EQ(s.inner, 1.0);
  EXPECT_THAT(s.pivots, ElementsAre(250, 3));
  ASSERT_EQ(s.patches.size(), 2u);
  EXPECT_EQ(s.patches[0].size_mm, 20);
  EXPECT_EQ(s.patches[1].name, "right");
  EXPECT_EQ(s.patches[1].size_mm, std::nullopt);
  const Palette palette = Palette::standard();
  EXPECT_THAT(s.boxes, ElementsAre(Pair(*palette.find("red"), ElementsAre(1, 2)),
                                   Pair(*palette.find("blue"), ElementsAre(3, 4))));
}

TEST(ReadParameters, KeepTheirDefaultsWhereTheFileIsSilent) {
  for (const char* yaml : {"", "{}", "group:\n"}) {
    Settings s;
    EXPECT_THAT(read(yaml, s), IsEmpty());
    EXPECT_EQ(s.gray_threshold, 40);
    EXPECT_EQ(s.height, std::nullopt);
    EXPECT_THAT(s.pivots, ElementsAre(1, 2));
  }
}

TEST(ReadParameters, AreEmptiedByNoneWhereTheyMayBeAbsent) {
  for (const char* yaml : {"height: none\ncenter: ~\n", "height:\ncenter: none\n"}) {
    Settings s;
    s.height = 3.0;
    s.center = cv::Point2d(1, 1);
    EXPECT_THAT(read(yaml, s), IsEmpty());
    EXPECT_EQ(s.height, std::nullopt);
    EXPECT_EQ(s.center, std::nullopt);
  }
}

TEST(ReadParameters, TakeABareScalarForAListOfOne) {
  Settings s;
  EXPECT_THAT(read("pivots: 7", s), IsEmpty());
  EXPECT_THAT(s.pivots, ElementsAre(7));
}

struct BadParameters {
  const char* yaml;
  std::vector<std::string> told;
};

TEST(ReadParameters, AreRefusedWithWhatWasFoundAndWhatWasExpected) {
  const std::string integer = ", expected an integer from 0 to 255";
  const std::string number = ", expected a number of at least 0";
  const std::string colors =
      " (known: orange, blue, yellow, red, green, magenta, cyan, purple, brown)";
  const BadParameters cases[] = {
      {"gray_threshold: 300", {"f.yaml:1:17: gray_threshold: 300 is out of range" + integer}},
      {"gray_threshold: -1", {"f.yaml:1:17: gray_threshold: -1 is out of range" + integer}},
      {"gray_threshold: 99999999999",
       {"f.yaml:1:17: gray_threshold: 99999999999 is out of range" + integer}},
      {"gray_threshold: 0x100000000",
       {"f.yaml:1:17: gray_threshold: 0x100000000 is out of range" + integer}},
      {"gray_threshold: 0x80000000000000000",
       {"f.yaml:1:17: gray_threshold: 0x80000000000000000 is out of range" + integer}},
      {"gray_threshold: 010",
       {"f.yaml:1:17: gray_threshold: found '010'" + integer + " without leading zeros"}},
      {"gray_threshold: 1.0", {"f.yaml:1:17: gray_threshold: found '1.0'" + integer}},
      {"gray_threshold: 12px", {"f.yaml:1:17: gray_threshold: found '12px'" + integer}},
      {"gray_threshold: 1 2", {"f.yaml:1:17: gray_threshold: found '1 2'" + integer}},
      {"gray_threshold: '12'", {"f.yaml:1:17: gray_threshold: found '12' in quotes" + integer}},
      {"gray_threshold: many", {"f.yaml:1:17: gray_threshold: found 'many'" + integer}},
      {"gray_threshold: [1]", {"f.yaml:1:17: gray_threshold: found a list" + integer}},
      {"gray_threshold: {a: 1}", {"f.yaml:1:17: gray_threshold: found a map" + integer}},
      {"gray_threshold:", {"f.yaml:1:1: gray_threshold: found nothing" + integer}},
      {"gain: .nan", {"f.yaml:1:7: gain: found '.nan'" + number}},
      {"gain: .inf", {"f.yaml:1:7: gain: found '.inf'" + number}},
      {"gain: inf", {"f.yaml:1:7: gain: found 'inf'" + number}},
      {"gain: 1e999", {"f.yaml:1:7: gain: 1e999 is out of range" + number}},
      {"gain: 01.5", {"f.yaml:1:7: gain: found '01.5'" + number + " without leading zeros"}},
      {"gain: 1,5", {"f.yaml:1:7: gain: found '1,5'" + number}},
      {"gain: \"1.5\"", {"f.yaml:1:7: gain: found '1.5' in quotes" + number}},
      {"enabled: yes", {"f.yaml:1:10: enabled: found 'yes', expected true or false"}},
      {"enabled: 1", {"f.yaml:1:10: enabled: found '1', expected true or false"}},
      {"enabled: 'true'", {"f.yaml:1:10: enabled: found 'true' in quotes, expected true or false"}},
      {"path: [a]", {"f.yaml:1:7: path: found a list, expected text"}},
      {"path: ~", {"f.yaml:1:1: path: found nothing, expected text"}},
      {"ball: cyam", {"f.yaml:1:7: ball: unknown colour 'cyam', did you mean 'cyan'?" + colors}},
      {"ball: background", {"f.yaml:1:7: ball: unknown colour 'background'" + colors}},
      {"span: [1, 2, 3]", {"f.yaml:1:7: span: found a list of 3, expected a list of 2 numbers"}},
      {"span: 1", {"f.yaml:1:7: span: found '1', expected a list of 2 numbers"}},
      {"span: [1, x]", {"f.yaml:1:11: span[1]: found 'x', expected a number from 0 to 255"}},
      {"center: [0, -1]",
       {"f.yaml:1:13: center[1]: -1 is out of range, expected a number from 0 "
        "to 1000"}},
      {"limit: 'none'",
       {"f.yaml:1:8: limit: found 'none' in quotes, expected an integer from 1 "
        "to 9"}},
      {"shape: disk",
       {"f.yaml:1:8: shape: unknown name 'disk', did you mean 'disc'? (known: "
        "square, disc)"}},
      {"group: 1", {"f.yaml:1:8: group: found '1', expected a map of parameters (known: inner)"}},
      {"group: {iner: 1}",
       {"f.yaml:1:9: group: unknown key 'iner', did you mean 'inner'? (known: inner)"}},
      {"pivots: {a: 1}", {"f.yaml:1:9: pivots: found a map, expected a list"}},
      {"pivots: []", {"f.yaml:1:9: pivots: found 0 entries, expected 1 to 3"}},
      {"pivots: [1, 2, 3, 4]", {"f.yaml:1:9: pivots: found 4 entries, expected 1 to 3"}},
      {"pivots: [1, -2, {b: 1}]",
       {"f.yaml:1:13: pivots[1]: -2 is out of range" + integer,
        "f.yaml:1:17: pivots[2]: found a map" + integer}},
      {"patches: [{size_mm: 2}]",
       {"f.yaml:1:11: patches[0].name: missing, expected text (what it is called)"}},
      {"patches: [left]",
       {"f.yaml:1:11: patches[0]: found 'left', expected a map of parameters "
        "(known: name, size_mm)"}},
      {"boxes: [1]", {"f.yaml:1:8: boxes: found a list, expected a map from colours"}},
      {"boxes: {rde: {y: [0, 1]}}",
       {"f.yaml:1:9: boxes: unknown colour 'rde', did you mean 'red'?" + colors}},
      {"boxes: {red: {y: [9, 1]}}",
       {"f.yaml:1:18: boxes.red.y: found a minimum above the maximum, expected min, max"}},
      {"[1]", {"f.yaml:1:1: found a list, expected a map of parameters"}},
      {"hue_pivots", {"f.yaml:1:1: found 'hue_pivots', expected a map of parameters"}},
  };
  for (const BadParameters& bad : cases) {
    Settings settings;
    EXPECT_EQ(read(bad.yaml, settings), bad.told) << bad.yaml;
  }
}

TEST(ReadParameters, NameTheNearestKeyForAnUnknownOne) {
  Settings s;
  EXPECT_THAT(read("gray_treshold: 3", s),
              ElementsAre("f.yaml:1:1: unknown key 'gray_treshold', did you mean "
                          "'gray_threshold'? (known: enabled, gray_threshold, gain, path, ball, "
                          "span, offset, limit, height, center, shape, group, pivots, patches, "
                          "boxes)"));
  EXPECT_THAT(read("wavelength: 3", s),
              ElementsAre(StartsWith("f.yaml:1:1: unknown key 'wavelength' (known: enabled, ")));
  EXPECT_THAT(read("a: 1", [](Parameters&) {}),
              ElementsAre("f.yaml:1:1: unknown key 'a', expected none"));
}

TEST(ReadParameters, ReportAllMistakesInFileOrder) {
  Settings s;
  EXPECT_THAT(read("nonsense: 1\n"
                   "gain: x\n"
                   "enabled: 2\n"
                   "group: {inner: 7, outer: 8}\n"
                   "gray_threshold: 999\n",
                   s),
              ElementsAre(HasSubstr(":1:1: unknown key"), HasSubstr(":2:7: gain"),
                          HasSubstr(":3:10: enabled"), HasSubstr(":4:16: group.inner"),
                          HasSubstr(":4:19: group: unknown key 'outer'"),
                          HasSubstr(":5:17: gray_threshold")));
  EXPECT_EQ(s.gray_threshold, 40) << "a mistake leaves the member as it was";
}

TEST(ReadParameters, ReportAMissingRequiredKeyAtItsMap) {
  std::string path;
  const Describe describe = [&](Parameters& p) {
    p.text({"path", "where frames come from", "", Presence::kRequired}, path);
  };
  EXPECT_THAT(read("", describe),
              ElementsAre("f.yaml:1:1: path: missing, expected text (where frames come from)"));
}

TEST(ReadParameters, KeepAListOfTheRightLengthForTheRulesThatCountOnIt) {
  std::vector<int> bounds{1, 2};
  const Describe describe = [&](Parameters& p) {
    p.list({"bounds", "lower, upper"}, bounds, {2, 2}, [](Parameters& e, int& bound) {
      e.integer({"", "one of them"}, bound, {0, 9});
    });
    p.check("bounds", bounds.at(0) <= bounds.at(1), "found lower above upper");
  };
  EXPECT_THAT(read("bounds: [99]", describe),
              ElementsAre("f.yaml:1:9: bounds: found 1 entry, expected 2",
                          "f.yaml:1:10: bounds[0]: 99 is out of range, expected an integer from 0 "
                          "to 9"));
  EXPECT_THAT(bounds, ElementsAre(1, 2));
}

TEST(ReadParameters, MayLackRequiredKeysWhereTheyAreAPart) {
  std::string path;
  int size = 1;
  std::vector<Mistake> mistakes;
  const auto read_part = [&](std::string_view yaml) {
    read_parameters(
        parse_document(yaml, "f.yaml"), Palette::standard(),
        [&](Parameters& p) {
          p.text({"path", "where", "", Presence::kRequired}, path);
          p.integer({"size", "how much"}, size, {0, 9});
          p.check("path", !path.empty(), "is empty, expected a file");
        },
        mistakes, Completeness::kPart);
  };
  read_part("size: 3");
  EXPECT_THAT(mistakes, IsEmpty());
  read_part("path: ''");
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_EQ(mistakes[0].to_string(), "f.yaml:1:7: path: is empty, expected a file");
}

TEST(ReadParameters, JudgeNoRuleBetweenValuesThatCouldNotBeRead) {
  int low = 1;
  int high = 2;
  const Describe describe = [&](Parameters& p) {
    p.integer({"low", "lower end"}, low, {0, 9});
    p.integer({"high", "upper end"}, high, {0, 9});
    p.check("low", low <= high, "found more than high, expected at most that");
  };
  EXPECT_THAT(read("low: 5\nhigh: 3", describe),
              ElementsAre("f.yaml:1:6: low: found more than high, expected at most that"));
  EXPECT_THAT(read("low: 5\nhigh: x", describe), ElementsAre(HasSubstr("high: found 'x'")));
}

TEST(ReadParameters, NeverPrintControlCharactersOrEndlessTextOfTheFile) {
  Settings s;
  const auto told = read("gain: \"\\e[31m" + std::string(500, 'x') + "\"", s);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("'\\x1b[31mxxx"));
  EXPECT_LT(told[0].size(), 200u);
}

class Picky final : public Stage {
 public:
  void describe(Parameters& p) override { p.integer({"size", "of it"}, size_, {0, 9}); }
  void prepare(const StageContext& /*context*/) override {
    if (size_ == 0) throw std::runtime_error("size 0 leaves nothing to do");
    prepared_with_ = size_;
  }
  int prepared_with() const { return prepared_with_; }

 private:
  int size_ = 1;
  int prepared_with_ = 0;
};

class Silent final : public Reporter {
 public:
  void warn(std::string_view /*message*/) override {}
};

TEST(ConfiguredStage, IsDescribedThenPrepared) {
  Silent reporter;
  const Palette palette = Palette::standard();
  Picky stage;
  configure_stage(stage, "size: 4", palette, reporter);
  EXPECT_EQ(stage.prepared_with(), 4);
  Picky broken;
  EXPECT_THROW(configure_stage(broken, "size: 40", palette, reporter), ConfigError);
  EXPECT_EQ(broken.prepared_with(), 0);
  Picky refusing;
  EXPECT_THROW(configure_stage(refusing, "size: 0", palette, reporter), std::runtime_error);
}

RC_GTEST_PROP(ReadNumbers, AreTheOnesThatWereWritten, (int integer, double number)) {
  RC_PRE(std::isfinite(number));
  const auto read_integer = parsed_integer(fmt::format("{}", integer));
  RC_ASSERT(std::get<int>(read_integer) == integer);
  const auto read_number = parsed_number(fmt::format("{}", number));
  RC_ASSERT(std::get<double>(read_number) == number);
}

}  // namespace
}  // namespace maggic
