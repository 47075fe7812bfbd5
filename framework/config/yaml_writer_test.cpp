#include "config/yaml_writer.hpp"

#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "config/trees_for_tests.hpp"
#include "maggic/document.hpp"

namespace maggic {
namespace {

Node tree(std::string_view yaml) { return parse_document(yaml, "test"); }

TEST(WrittenYaml, IsBlockStyleWithShortListsOnOneLine) {
  EXPECT_EQ(to_yaml(tree("{a: {b: [1, 2], c: ~}, d: [{e: f}, 'g h'], i: {}, j: []}")),
            "a:\n"
            "  b: [1, 2]\n"
            "  c: ~\n"
            "d:\n"
            "  -\n"
            "    e: f\n"
            "  - \"g h\"\n"
            "i: {}\n"
            "j: []\n");
  EXPECT_EQ(to_yaml(tree("plain text")), "plain text\n");
  EXPECT_EQ(to_yaml(Node()), "~\n");
}

TEST(WrittenYaml, QuotesWhatWouldBeReadAsSomethingElse) {
  for (const char* text :
       {"",  "~", "null", "a: b", "a #b", "- a", "#",  "[a", "{a", "*a",  "&a",   "!a", "|",   ">",
        "%", "@", "`",    "'",    "\"",   " a",  "a ", "a:", "<<", "---", "a\nb", "\t", "\x1b"}) {
    const Node again = tree(to_yaml(trees::scalar(text, false)));
    EXPECT_EQ(again.kind, Node::Kind::kScalar) << text;
    EXPECT_EQ(again.scalar, text);
  }
}

TEST(WrittenYaml, KeepsPlainTextPlainAndQuotedTextQuoted) {
  for (const char* text :
       {"1", "-1", "-.5", "true", "a b", "http://h:80/x?y=z", "a,b", "a]b", "é"}) {
    EXPECT_FALSE(tree(to_yaml(trees::scalar(text, false))).quoted) << text;
    EXPECT_TRUE(tree(to_yaml(trees::scalar(text, true))).quoted) << text;
  }
}

/// Everything but places, and whether text that cannot stand plain was marked as quoted.
bool is_same(const Node& a, const Node& b) {
  if (a.kind != b.kind || a.scalar != b.scalar || a.items.size() != b.items.size() ||
      a.entries.size() != b.entries.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (!is_same(a.items[i], b.items[i])) return false;
  }
  for (std::size_t i = 0; i < a.entries.size(); ++i) {
    if (a.entries[i].key != b.entries[i].key) return false;
    if (!is_same(a.entries[i].value, b.entries[i].value)) return false;
  }
  return true;
}

RC_GTEST_PROP(WrittenYaml, IsReadBackAsTheSameTree, ()) {
  const Node root = *trees::any_tree(3);
  const Node again = tree(to_yaml(root));
  RC_ASSERT(is_same(again, root));
  RC_ASSERT(is_same(tree(to_flow_yaml(root)), root));
  RC_ASSERT(to_yaml(again) == to_yaml(root));
}

RC_GTEST_PROP(ParsedDocument, NeverFailsButWithAConfigError, (const std::string& bytes)) {
  try {
    parse_document(bytes, "test");
  } catch (const ConfigError& e) {
    RC_ASSERT(!e.mistakes().empty());
  }
}

}  // namespace
}  // namespace maggic
