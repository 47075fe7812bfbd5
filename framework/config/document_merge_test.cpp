#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "config/trees_for_tests.hpp"
#include "config/yaml_writer.hpp"
#include "maggic/document.hpp"

namespace maggic {
namespace {

Node tree(std::string_view yaml) { return parse_document(yaml, "test"); }

std::string merged(std::string_view base, std::string_view over) {
  Node root = tree(base);
  merge_document(root, tree(over));
  return to_flow_yaml(root);
}

std::string set(std::string_view base, std::string_view assignment) {
  Node root = tree(base);
  try {
    set_in_document(root, assignment);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return to_flow_yaml(root);
}

TEST(MergedDocument, TakesMapsKeyByKeyAndReplacesTheRest) {
  EXPECT_EQ(merged("{a: {x: 1, y: 2}, b: [1, 2]}", "{a: {y: 3, z: 4}, b: [5]}"),
            "{a: {x: 1, y: 3, z: 4}, b: [5]}");
  EXPECT_EQ(merged("{a: 1}", "{a: {x: 1}}"), "{a: {x: 1}}");
  EXPECT_EQ(merged("{a: {x: 1}}", "{a: 1}"), "{a: 1}");
  EXPECT_EQ(merged("~", "{a: 1}"), "{a: 1}");
}

TEST(MergedDocument, LosesKeysThatAreSetToNothing) {
  EXPECT_EQ(merged("{a: 1, b: {c: 2, d: 3}}", "{a: ~, b: {c: ~}, e: ~}"), "{b: {d: 3}}");
  EXPECT_EQ(merged("{}", "{a: {b: ~, c: 1}}"), "{a: {c: 1}}");
}

TEST(MergedDocument, StaysAsItIsUnderAnEmptyFile) { EXPECT_EQ(merged("{a: 1}", ""), "{a: 1}"); }

TEST(MergedDocument, KeepsThePlaceOfEveryValue) {
  Node root = parse_document("a: {x: 1}\n", "base.yaml");
  merge_document(root, parse_document("\na: {y: 2}\n", "over.yaml"));
  EXPECT_EQ(root.find("a")->find("x")->place.file, "base.yaml");
  EXPECT_EQ(root.find("a")->find("y")->place.file, "over.yaml");
  EXPECT_EQ(root.find("a")->find("y")->place.line, 2);
}

TEST(Assignment, SetsAValueAndMakesTheMapsOnTheWay) {
  EXPECT_EQ(set("{a: {b: 1}}", "a.b=2"), "{a: {b: 2}}");
  EXPECT_EQ(set("{a: 1}", "b.c.d=x"), "{a: 1, b: {c: {d: x}}}");
  EXPECT_EQ(set("~", "a={x: [1, 2]}"), "{a: {x: [1, 2]}}");
  EXPECT_EQ(set("{}", "a=b=c"), "{a: b=c}");
  EXPECT_EQ(set("{a: {b: 1, c: 2}}", "a.b=~"), "{a: {c: 2}}");
}

TEST(Assignment, NumbersTheItemsOfAList) {
  EXPECT_EQ(set("{a: [x, {y: 1}]}", "a.1.y=2"), "{a: [x, {y: 2}]}");
  EXPECT_EQ(set("{a: [x, y]}", "a.0="), "{a: [y]}");
  EXPECT_EQ(set("{a: {}}", "a.0=x"), "{a: {0: x}}");
  EXPECT_EQ(set("{a: [x]}", "a.1=y"),
            "--set:1:3: found '1', expected the number of an item of a list of 1 (from 0)");
  EXPECT_EQ(set("{a: [x]}", "a.first=y"),
            "--set:1:3: found 'first', expected the number of an item of a list of 1 (from 0)");
}

TEST(Assignment, RefusesWhatIsNoPathAndNoValue) {
  EXPECT_EQ(set("{}", "a.b"), "--set:1:1: found 'a.b', expected path.to.key=value");
  EXPECT_EQ(set("{}", "=1"),
            "--set:1:1: found an empty name in the path '', expected path.to.key=value");
  EXPECT_EQ(set("{}", "a..b=1"),
            "--set:1:3: found an empty name in the path 'a..b', expected path.to.key=value");
  EXPECT_EQ(set("{a: x}", "a.b=1"),
            "--set:1:3: found 'x' where the path goes on to 'b', expected a map or a list");
  EXPECT_EQ(set("{}", "a={x: 1, x: 2}"),
            "--set:1:10: found the key 'x' again, expected it once (first at --set:1:4)");
}

TEST(Assignment, PlacesTheValueWhereItIsWritten) {
  Node root;
  set_in_document(root, "größe.b=[1, 2]");
  const Node& second = root.find("größe")->find("b")->items[1];
  EXPECT_EQ(second.place.file, "--set");
  EXPECT_EQ(second.place.line, 1);
  EXPECT_EQ(second.place.column, 13);
}

RC_GTEST_PROP(MergedDocument, IsUnchangedByAnEmptyMapAndByItself, ()) {
  Node root = *trees::any_map();
  const std::string before = to_yaml(root);
  merge_document(root, tree("{}"));
  RC_ASSERT(to_yaml(root) == before);
  merge_document(root, trees::without_nulls(root));
  RC_ASSERT(to_yaml(root) == before);
}

RC_GTEST_PROP(MergedDocument, IsTheSameMergedOnceOrTwice, ()) {
  Node once = *trees::any_map();
  const Node over = *trees::any_map();
  merge_document(once, over);
  Node twice = once;
  merge_document(twice, over);
  RC_ASSERT(to_yaml(twice) == to_yaml(once));
}

RC_GTEST_PROP(MergedDocument, HoldsEveryValueOfTheUpperDocument, ()) {
  Node root = *trees::any_map();
  const Node over = *trees::any_map();
  merge_document(root, over);
  for (const Node::Entry& entry : over.entries) {
    const Node* value = root.find(entry.key);
    if (entry.value.kind == Node::Kind::kNull) {
      RC_ASSERT(value == nullptr);
    } else if (entry.value.kind != Node::Kind::kMap) {
      RC_ASSERT(value != nullptr && to_yaml(*value) == to_yaml(entry.value));
    }
  }
}

}  // namespace
}  // namespace maggic
