// SPDX-License-Identifier: Apache-2.0
#pragma once
// Facts that a subcommand prints when it is done: sentences for people, or with --json one object. Sentences are made
// of named values, which are the members of the object: both say the same.
//
//   Facts facts("limit");
//   facts.say("{output}: {points} limit points of level {level}\n", {{"output", path}, {"points", 98}, {"level", 1}});
//   facts.print(options.common);
//
//   out.ply: 98 limit points of level 1
//   {"verb": "limit", "output": "out.ply", "points": 98, "level": 1}
#include <CLI/CLI.hpp>

#include <concepts>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace sublimit::cli {

struct Common;

/// A named value, and its words in sentences.
struct Fact {
  std::string name;  ///< of the member: words of the sentence with _ between
  nlohmann::ordered_json value;
  std::string text;

  Fact(std::string name_, std::string value_) : name(std::move(name_)), value(value_), text(std::move(value_)) {}
  Fact(std::string name_, const char* value_) : Fact(std::move(name_), std::string(value_)) {}
  Fact(std::string name_, std::integral auto value_)
      : name(std::move(name_)), value(value_), text(std::to_string(value_)) {}
  /// A number in the shortest form that reads back to the same bits.
  Fact(std::string name_, double value_);
  /// A value that sentences say in other words.
  Fact(std::string name_, nlohmann::ordered_json value_, std::string text_)
      : name(std::move(name_)), value(std::move(value_)), text(std::move(text_)) {}
};

/// Adds --json to a subcommand that prints facts.
void add_json(CLI::App& command, Common& common);

/// A size: a number of bytes, "1.5 GB" in sentences.
Fact bytes_fact(std::string name, double bytes);
/// A time: seconds, "0.123 s" in sentences.
Fact seconds_fact(std::string name, double seconds);

/// A number, three digits of it in sentences.
Fact three_digits(std::string name, double value);

class Facts {
 public:
  explicit Facts(const std::string& verb) : object_{{"verb", verb}} {}

  /// Adds a sentence, or a part of one, whose {names} stand for facts. Facts that it does not name are members alone.
  void say(std::string_view sentence, std::initializer_list<Fact> facts = {});
  /// Adds members without words.
  void add(std::initializer_list<Fact> facts) { say("", facts); }

  const std::string& text() const { return text_; }
  const nlohmann::ordered_json& object() const { return object_; }

  /// Prints to stdout: with --json the object, else, unless --quiet, the sentences.
  void print(const Common& common) const;

 private:
  std::string text_;
  nlohmann::ordered_json object_;
};

}  // namespace sublimit::cli
