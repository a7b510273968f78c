// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/json/json_object.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using Parts = std::initializer_list<std::string_view>;

TEST(JsonObject, ReadsFieldsByName) {
  const JsonValue value = parse_json(R"({"n": 3, "x": "1/4", "on": true, "list": [1, 2.0, 4e0], "word": "loop"})", "a");
  JsonObject object(value, "a");
  EXPECT_EQ(object.integer("n", 0, 3), 3);
  EXPECT_EQ(object.number("x").value, 0.25);
  EXPECT_EQ(object.number_or("y", 7), 7);
  EXPECT_TRUE(object.flag_or("on", false));
  EXPECT_EQ(object.integers("list", 1, 4), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(object.unread(), std::vector<std::string>{"word"});
  expect_error<FormatError>([&] { object.finish(); }, {"a: unknown field \"word\"", "there are list, n, on, x, y"});
  EXPECT_EQ(object.word("word", std::vector<const char*>{"doo-sabin", "loop"}), 1u);
  object.finish();
}

TEST(JsonObject, SaysWhereAndWhatWouldBeRight) {
  const auto expect = [](const std::string& text, const auto& read, Parts parts) {
    const JsonValue value = parse_json(text, "a.json");
    JsonObject object(value, "a.json", "in.");
    expect_error<FormatError>([&] { read(object), object.finish(); }, parts);
  };
  const auto levels = [](JsonObject& object) { object.integer("levels", 0, 11); };
  expect("{}", levels, {"a.json: the field in.levels is missing; it should be a whole number"});
  expect(R"({"levels": 12})", levels, {"a.json: in.levels: is 12; it should be a whole number from 0 to 11"});
  expect(R"({"levels": 1, "level": 2})", levels, {"unknown field \"level\" in in; the nearest are levels"});
  const auto ids = [](JsonObject& object) { object.integers("ids", 0, 4, "a vertex"); };
  expect(R"({"ids": [0, 5]})", ids, {"a.json: in.ids[1]: is 5; it should be a vertex from 0 to 4"});
  expect(R"({"ids": {}})", ids, {"a.json: in.ids: is an object; it should be a list"});
  expect(R"({"on": 1})", [](JsonObject& o) { o.flag_or("on", true); }, {"in.on: is 1; it should be true or false"});
}

TEST(JsonObject, ManyFieldsAreReadAtOnce) {
  std::string text = "{";
  for (int i = 0; i < 20'000; ++i) text += "\"" + std::to_string(i) + "\": 0, ";
  const JsonValue value = parse_json(text + "\"last\": 1}", "a");
  EXPECT_EQ(JsonObject(value, "a").unread().size(), 20'001u);
}

TEST(JsonValue, LinesAreNamed) {
  expect_error<FormatError>([] { parse_json("{\n\n]", "a.json"); }, {"a.json:3: not JSON"});
  expect_error<FormatError>([] { parse_json("{]", "a.jsonl", 7); }, {"a.jsonl:7: not JSON"});
  expect_error<FormatError>([] { parse_json(R"({"x": 1, "x": 2})", "a.jsonl", 7); },
                            {"a.jsonl:7: has the field \"x\" twice"});
  expect_error<FormatError>([] { parse_json(R"([{"x": {"y": 1, "y": 2}}])", "a.json"); }, {"the field \"y\" twice"});
  expect_error<FormatError>([] { parse_json(std::string(1'000'000, '['), "a.json"); }, {"a.json: nests deeper"});
}

}  // namespace
}  // namespace sublimit::testing
