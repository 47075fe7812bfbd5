#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "maggic/parameter_reader.hpp"

namespace maggic {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> table(const Describe& describe) {
  std::vector<std::string> lines;
  for (const ParameterRow& r : parameter_table(Palette::standard(), describe)) {
    lines.push_back(fmt::format("{}; {}; {}; {}; {}; {}", r.path, r.type, r.default_value, r.range,
                                r.unit, r.meaning));
  }
  return lines;
}

TEST(ParameterTable, HasARowForEveryParameter) {
  bool enabled = true;
  int threshold = 40;
  double gain = 100.0;
  std::string path;
  Label ball = 1;
  std::array<double, 2> span{0, 0.5};
  int shape = 1;
  double inner = 0.25;
  EXPECT_THAT(table([&](Parameters& p) {
                p.boolean({"enabled", "whether"}, enabled);
                p.integer({"threshold", "limit", "steps"}, threshold, {0, 255});
                p.number({"gain", "factor"}, gain, {0.0, std::numeric_limits<double>::max()});
                p.text({"path", "where", "", Presence::kRequired}, path);
                p.text({"label", "name"}, path);
                p.color({"ball", "colour of it"}, ball);
                p.numbers({"span", "from, to", "px"}, span, {0, 1});
                p.choice<int>({"shape", "form"}, shape, {{"square", 0}, {"disc", 1}});
                p.group({"group", "more"}, [&](Parameters& g) {
                  g.number({"inner", "in"}, inner, {0, 1});
                });
              }),
              ElementsAre("enabled; true or false; true; ; ; whether",
                          "threshold; integer; 40; 0 … 255; steps; limit",
                          "gain; number; 100; ≥ 0; ; factor", "path; text; required; ; ; where",
                          "label; text; \"\"; ; ; name", "ball; colour; orange; ; ; colour of it",
                          "span; [number ×2]; [0, 0.5]; 0 … 1; px; from, to",
                          "shape; one of square|disc; disc; ; ; form", "group; map; ; ; ; more",
                          "group.inner; number; 0.25; 0 … 1; ; in"));
}

TEST(ParameterTable, ShowsNoneWhereAValueMayBeAbsent) {
  std::optional<double> height;
  std::optional<int> limit = 3;
  std::optional<cv::Point2d> center;
  EXPECT_THAT(
      table([&](Parameters& p) {
        p.number({"height", "above"}, height, {5, 10});
        p.integer({"limit", "most"}, limit, {1, 9});
        p.point({"center", "middle"}, center, {0, 9});
      }),
      ElementsAre("height; number; none; 5 … 10; ; above", "limit; integer; 3; 1 … 9; ; most",
                  "center; [number ×2]; none; 0 … 9; ; middle"));
  EXPECT_EQ(height, std::nullopt);
}

TEST(ParameterTable, ShowsListsOfValuesInOneRowAndListsOfMapsWithTheirMembers) {
  struct Patch {
    std::string name = "patch";
    double size_mm = 30;
  };
  std::vector<int> pivots{1, 2};
  std::vector<Patch> patches{{"left", 20}};
  EXPECT_THAT(table([&](Parameters& p) {
                p.list({"pivots", "hues"}, pivots, {1, 3}, [](Parameters& e, int& hue) {
                  e.integer({"", "hue", "steps"}, hue, {0, 255});
                });
                p.list({"patches", "of the tag"}, patches, {0, 8}, [](Parameters& e, Patch& patch) {
                  e.text({"name", "called", "", Presence::kRequired}, patch.name);
                  e.number({"size_mm", "edge", "mm"}, patch.size_mm, {1, 100});
                });
              }),
              ElementsAre("pivots; [integer]; [1, 2]; 0 … 255, 1 … 3 entries; steps; hues",
                          "patches; list; [{name: left, size_mm: 20}]; 0 … 8 entries; ; of the tag",
                          "patches[].name; text; required; ; ; called",
                          "patches[].size_mm; number; 30; 1 … 100; mm; edge"));
  EXPECT_EQ(patches.size(), 1u) << "describing changes nothing";
}

TEST(ParameterTable, ShowsColourMapsWithAPlaceholderForTheColour) {
  const Label red = *Palette::standard().find("red");
  std::vector<std::pair<Label, std::array<double, 2>>> boxes{{red, {1, 2}}};
  std::vector<std::pair<Label, int>> hues{{red, 7}};
  EXPECT_THAT(table([&](Parameters& p) {
                p.by_color({"boxes", "limits"}, boxes, {0, 9}, [](Parameters& e, auto& box) {
                  e.numbers({"y", "luma"}, box, {0, 255});
                });
                p.by_color({"hues", "pivot"}, hues, {0, std::numeric_limits<int>::max()},
                           [](Parameters& e, int& hue) {
                             e.integer({"", "hue"}, hue, {0, 255});
                           });
              }),
              ElementsAre("boxes; map by colour; {red: {y: [1, 2]}}; 0 … 9 entries; ; limits",
                          "boxes.<color>.y; [number ×2]; [0, 0]; 0 … 255; ; luma",
                          "hues.<color>; integer; {red: 7}; 0 … 255; ; pivot"));
}

TEST(ParameterValues, AreWhatWouldBeReadAsTheSame) {
  const Label red = *Palette::standard().find("red");
  struct Settings {
    int threshold = 40;
    std::optional<double> height;
    std::string name = "12";
    std::vector<std::pair<Label, std::vector<int>>> pivots;

    void describe(Parameters& p) {
      p.integer({"threshold", "limit"}, threshold, {0, 255});
      p.number({"height", "above"}, height, {0, 10});
      p.text({"name", "called"}, name);
      p.by_color({"pivots", "hues"}, pivots, {0, 9}, [](Parameters& color, std::vector<int>& hues) {
        color.list({"", "hues"}, hues, {1, 9},
                   [](Parameters& e, int& hue) { e.integer({"", "hue"}, hue, {0, 255}); });
      });
    }
  };
  Settings settings{.threshold = 7, .height = 2.5, .pivots = {{red, {250, 3}}}};
  const Node values =
      parameter_values(Palette::standard(), [&](Parameters& p) { settings.describe(p); });
  Settings read;
  std::vector<Mistake> mistakes;
  read_parameters(parse_document(to_yaml(values), "values"), Palette::standard(),
                  [&](Parameters& p) { read.describe(p); }, mistakes);
  EXPECT_THAT(mistakes, ::testing::IsEmpty());
  EXPECT_EQ(read.threshold, 7);
  EXPECT_EQ(read.height, 2.5);
  EXPECT_EQ(read.name, "12");
  EXPECT_EQ(read.pivots, settings.pivots);
}

}  // namespace
}  // namespace maggic
