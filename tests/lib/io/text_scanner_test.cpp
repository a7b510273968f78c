// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/text_scanner.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sublimit::testing {
namespace {

using Words = std::vector<std::string>;

/// The words of each line that has some.
std::vector<Words> lines(const std::string& text, TextScanner::Continuation continuation) {
  TextScanner scanner(text, "a", continuation);
  std::vector<Words> all;
  while (scanner.next_filled_line()) {
    all.emplace_back();
    for (std::string_view token; !(token = scanner.token()).empty();) all.back().emplace_back(token);
  }
  return all;
}

TEST(TextScanner, BlanksBehindABackslashContinueALine) {
  using enum TextScanner::Continuation;
  const std::vector<Words> expected{{"v", "1", "2"}, {"f", "3"}};
  for (const std::string text :
       {"v 1 \\\n2\nf 3", "v 1 \\ \n2\nf 3", "v 1\\ \t\r\n2\nf\\  \n 3", "v \\ \r\\\t\r1 \\\v\f\n2\nf 3 \\  ",
        "v 1 2 \\ \n\nf 3 # a comment \\ \n", "v 1 2 \\ \n # a comment \\ \nf 3 \\"})
    EXPECT_EQ(lines(text, backslash), expected) << text;
  // Elsewhere in a line, and before a comment, it is a letter.
  EXPECT_EQ(lines("g a\\b \\ c \\# d\n1", backslash), (std::vector<Words>{{"g", "a\\b", "\\", "c", "\\"}, {"1"}}));
  EXPECT_EQ(lines("v \\ \n2", none), (std::vector<Words>{{"v", "\\"}, {"2"}}));
}

TEST(TextScanner, CountsContinuedLines) {
  const std::string text = "1 \\ \n\\\t\n 2\n3\n";
  TextScanner scanner(text, "a", TextScanner::Continuation::backslash);
  for (const std::int64_t line : {1, 3}) {
    EXPECT_FALSE(scanner.token_of_any_line().empty());
    EXPECT_EQ(scanner.line(), line);
  }
  EXPECT_EQ(scanner.token_of_any_line(), "3");
  EXPECT_EQ(scanner.place(), "a:4: ");
  EXPECT_EQ(scanner.token_of_any_line(), "");
}

}  // namespace
}  // namespace sublimit::testing
