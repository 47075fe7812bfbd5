#include "maggic/document.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace maggic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> mistakes_in(std::string_view text, const DocumentLimits& limits = {}) {
  std::vector<std::string> told;
  try {
    parse_document(text, "f.yaml", limits);
  } catch (const ConfigError& e) {
    for (const Mistake& m : e.mistakes()) told.push_back(m.to_string());
  }
  return told;
}

std::string place_of(const Node& node) {
  return node.place.file + ':' + std::to_string(node.place.line) + ':' +
         std::to_string(node.place.column);
}

TEST(ParsedDocument, HoldsScalarsSequencesAndMapsInFileOrder) {
  const Node root = parse_document("b: 1\na: [x, 'y']\nc:\n  d: ~\n", "f.yaml");
  ASSERT_EQ(root.kind, Node::Kind::kMap);
  ASSERT_EQ(root.entries.size(), 3u);
  EXPECT_EQ(root.entries[0].key, "b");
  EXPECT_EQ(root.find("b")->scalar, "1");
  ASSERT_EQ(root.find("a")->items.size(), 2u);
  EXPECT_FALSE(root.find("a")->items[0].quoted);
  EXPECT_TRUE(root.find("a")->items[1].quoted);
  EXPECT_EQ(root.find("c")->find("d")->kind, Node::Kind::kNull);
  EXPECT_EQ(root.find("e"), nullptr);
  EXPECT_EQ(root.find("b")->find("e"), nullptr);
}

TEST(ParsedDocument, CountsPlacesFromOneInCharacters) {
  const Node root = parse_document("größe: [µ, 7]\nb:\n  c: x\n", "f.yaml");
  EXPECT_EQ(place_of(root), "f.yaml:1:1");
  EXPECT_EQ(place_of(root.find("größe")->items[1]), "f.yaml:1:12");
  EXPECT_EQ(place_of(*root.find("b")->find("c")), "f.yaml:3:6");
  EXPECT_EQ(root.find("b")->entries[0].key_place.column, 3);
}

TEST(ParsedDocument, PlacesAMissingValueAtItsKey) {
  const Node root = parse_document("a: 1\nlast:\n", "f.yaml");
  EXPECT_EQ(place_of(*root.find("last")), "f.yaml:2:1");
  const Node inner = parse_document("a:\nb: 1\n", "f.yaml");
  EXPECT_EQ(place_of(*inner.find("a")), "f.yaml:1:1");
}

TEST(ParsedDocument, WithoutContentIsNull) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "---\n", "---\n...\n", "~"}) {
    EXPECT_EQ(parse_document(text, "f.yaml").kind, Node::Kind::kNull) << text;
  }
}

TEST(ParsedDocument, TakesByteOrderMarkAndWindowsLineEnds) {
  const Node root = parse_document(
      "\xEF\xBB\xBF"
      "a: 1\r\nb: |\r\n  x\r\n  y\r\n",
      "f.yaml");
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.find("b")->scalar, "x\ny\n");
  EXPECT_EQ(root.entries[1].key_place.line, 2);
  EXPECT_EQ(root.entries[0].key_place.column, 1);
}

TEST(ParsedDocument, WritesAliasesOut) {
  const Node root = parse_document("a: &list [1, 2]\nb: *list\n", "f.yaml");
  ASSERT_EQ(root.find("b")->items.size(), 2u);
  EXPECT_EQ(root.find("b")->items[1].scalar, "2");
  EXPECT_EQ(root.find("b")->items[1].place.line, 1) << "a mistake is where the value is written";
}

struct BadText {
  std::string text;
  std::vector<std::string> told;
};

TEST(ParsedDocument, RefusesWhatIsNotInTheSubsetWithItsPlace) {
  const BadText cases[] = {
      {"a: 1\nb: 2\na: 3\n",
       {"f.yaml:3:1: found the key 'a' again, expected it once (first at f.yaml:1:1)"}},
      {"a: {x: 1, x: 2}\nb: [{y: 1, y: 2}]\n",
       {"f.yaml:1:11: found the key 'x' again, expected it once (first at f.yaml:1:5)",
        "f.yaml:2:12: found the key 'y' again, expected it once (first at f.yaml:2:6)"}},
      {"a: &a {x: 1}\nb:\n  <<: *a\n",
       {"f.yaml:3:3: found the merge key '<<', expected the values to be written out"}},
      {"a: !!str 7\nb: !mine {}\n",
       {"f.yaml:1:4: found the tag 'tag:yaml.org,2002:str', expected a value without a tag",
        "f.yaml:2:4: found the tag '!mine', expected a value without a tag"}},
      {"? [a]\n: 1\n? {b: 1}\n: 2\n",
       {"f.yaml:1:3: found a list as a key, expected text",
        "f.yaml:3:3: found a map as a key, expected text"}},
      {"~: 1\n", {"f.yaml:1:1: found nothing as a key, expected text"}},
      {"a: &k x\n*k : 1\n", {"f.yaml:2:1: found an alias as a key, expected text"}},
      {"a: 1\n---\nb: 2\n",
       {"f.yaml:2:1: found more after the end of the document, expected only one"}},
      {"[1]\nb", {"f.yaml:2:1: found more after the end of the document, expected only one"}},
      {"a: &loop [*loop]\n",
       {"f.yaml:1:11: found an alias to a node that contains it, expected no cycles"}},
      {"a: &m\n  b: {c: *m}\n",
       {"f.yaml:2:10: found an alias to a node that contains it, expected no cycles"}},
      {"a: *nobody\n", {"f.yaml:1:4: found no valid YAML: the referenced anchor is not defined"}},
      {"a: 1\n\tb: 2\n", {"f.yaml:2:1: found a tab as indentation, expected spaces"}},
      {"a: b: c\n",
       {"f.yaml:1:5: found a ':' where no key can be, expected one 'key: value' a "
        "line, evenly indented"}},
      {"a:\n  b: 1\n c: 2\n",
       {"f.yaml:3:2: found a line that is indented unlike those above, "
        "expected even indentation"}},
      {"a: [1, 2\n", {"f.yaml:2:1: found no ']' for a '[' above, expected one"}},
      {"a: {b: 2\n", {"f.yaml:2:1: found no '}' for a '{' above, expected one"}},
      {"a: 'open\n", {"f.yaml:2:1: found the end inside quotes, expected them closed"}},
      {"a: \"open", {"f.yaml:2:1: found the end inside quotes, expected them closed"}},
      {"a: 1\nb: \"\\q\"\n", {"f.yaml:2:7: found no valid YAML: unknown escape character: q"}},
      {"a: \"\\0\"\nb: \"\\N\"\n",
       {"f.yaml:1:4: found an escape for NUL, \\N or \\_, expected text without them",
        "f.yaml:2:4: found an escape for NUL, \\N or \\_, expected text without them"}},
      {std::string(300, 'k') + ": 1\n",
       {"f.yaml:1:1: found a key of 300 bytes, expected at most 256"}},
  };
  for (const BadText& bad : cases) EXPECT_EQ(mistakes_in(bad.text), bad.told) << bad.text;
}

TEST(ParsedDocument, RefusesBytesThatAreNoText) {
  using namespace std::string_literals;
  const std::string cases[] = {"\0"s,
                               "\x04"s,
                               "\x1b[31m"s,
                               "\x7f"
                               "ELF"s,
                               "\xff\xfe"
                               "a\0"s,
                               "\x80"s,
                               "\xc0\xaf"s,
                               "\xed\xa0\x80"s,
                               "\xf4\x90\x80\x80"s,
                               "\xe2\x82"s,
                               "\xc2\x9b"s,
                               "x\xEF\xBB\xBF"s,
                               "\r"s};
  for (const std::string& bytes : cases) {
    EXPECT_THAT(mistakes_in("a: 1\nb: \"" + bytes),
                ElementsAre(AllOf(StartsWith("f.yaml:2:"), HasSubstr("no text, expected YAML"))));
  }
  EXPECT_THAT(mistakes_in("a: \xff"s),
              ElementsAre("f.yaml:1:4: found byte 0xff, which is no text, expected YAML in UTF-8"));
}

TEST(ParsedDocument, TellsEveryMistakeUpToTheOneThatEndsTheReading) {
  EXPECT_THAT(mistakes_in("a: 1\na: 2\n~: 3\nb: ]\n"),
              ElementsAre(StartsWith("f.yaml:2:1: "), StartsWith("f.yaml:3:1: "),
                          StartsWith("f.yaml:4:4: found no valid YAML")));
}

std::string laughs(std::string_view first, int generations) {
  std::string text = "a0: &a0 " + std::string(first) + "\n";
  for (int i = 1; i < generations; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 0; k < 9; ++k) text += ", " + last;
    text += "]\n";
  }
  return text;
}

TEST(ParsedDocument, RefusesFilesThatGrowWithoutBound) {
  EXPECT_THAT(mistakes_in(laughs("x", 12)), ElementsAre(HasSubstr("more than 100000 nodes")));
  EXPECT_THAT(mistakes_in(laughs(std::string(500'000, 'x'), 3)),
              ElementsAre(HasSubstr("more than 2097152 bytes of text")));
  const DocumentLimits shallow{.max_depth = 3};
  EXPECT_THAT(mistakes_in("[[[]]]", shallow), ElementsAre());
  EXPECT_THAT(mistakes_in("[[[[]]]]", shallow),
              ElementsAre("f.yaml:1:4: found nodes nested more than 3 deep, expected less"));
  EXPECT_THAT(mistakes_in("a: &a [[]]\nb: [*a]\n", shallow),
              ElementsAre(HasSubstr("f.yaml:2:5: found nodes nested more than 3 deep once")));
  EXPECT_THAT(mistakes_in(std::string(20, 'x'), {.max_bytes = 10}),
              ElementsAre("f.yaml: found 20 bytes, expected at most 10"));
}

TEST(ParsedDocument, IsReadInTimeWhateverIsRepeated) {
  const auto begin = std::chrono::steady_clock::now();
  for (const char* piece : {"[", "{", "- ", "? ", "a: ", "[a,", "{a: ", "&a ", "!a ", "\"a\" ", "'",
                            "#\n", "---\n", ":", "-", "[\n", "a:\n ", "*a "}) {
    std::string text;
    while (text.size() < 20'000) text += piece;
    mistakes_in(text);
    mistakes_in("[" + text + "]");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

class LoadedDocument : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "maggic_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string mistake(const std::filesystem::path& file, const DocumentLimits& limits = {}) {
    try {
      load_document(file, limits);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(LoadedDocument, IsReadFromItsFile) {
  const auto file = folder_ / "good.yaml";
  std::ofstream(file) << "a: 1\n";
  const Node root = load_document(file);
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.place.file, file.string());
}

TEST_F(LoadedDocument, NamesAFileThatIsNone) {
  EXPECT_EQ(mistake(folder_), folder_.string() + ": found a directory, expected a YAML file");
  const auto missing = folder_ / "missing.yaml";
  EXPECT_EQ(mistake(missing), missing.string() + ": found no such file, expected a YAML file");
  EXPECT_EQ(mistake(""), ": found no such file, expected a YAML file");
  EXPECT_THAT(mistake("/dev/zero"), HasSubstr("no regular file"));
  const auto loop = folder_ / "loop.yaml";
  std::filesystem::create_symlink(loop, loop);
  EXPECT_THAT(mistake(loop), HasSubstr("cannot be read"));
  const auto big = folder_ / "big.yaml";
  std::ofstream(big) << std::string(100, '#');
  EXPECT_THAT(mistake(big, {.max_bytes = 99}), HasSubstr("more than 99 bytes"));
}

TEST_F(LoadedDocument, NamesAFileThatMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const auto file = folder_ / "secret.yaml";
  std::ofstream(file) << "a: 1\n";
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THAT(mistake(file), HasSubstr("cannot be opened for reading"));
}

}  // namespace
}  // namespace maggic
