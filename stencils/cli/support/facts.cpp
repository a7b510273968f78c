// SPDX-License-Identifier: Apache-2.0
#include "support/facts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "support/common.h"

namespace sublimit::cli {

Fact::Fact(std::string name_, double value_) : name(std::move(name_)), value(value_), text(format_number(value_)) {
  if (!std::isfinite(value_)) value = text;  // JSON has no such numbers
}

void add_json(CLI::App& command, Common& common) {
  command.add_flag("--json", common.json, "Print what is told at the end as a JSON object");
}

Fact bytes_fact(std::string name, double bytes) {
  return {std::move(name), static_cast<std::int64_t>(bytes), bytes_in_words(bytes)};
}

Fact seconds_fact(std::string name, double seconds) {
  return {std::move(name), seconds, fmt::format("{:.3f} s", seconds)};
}

Fact three_digits(std::string name, double value) {
  Fact fact(std::move(name), value);
  fact.text = fmt::format("{:.3g}", value);
  return fact;
}

void Facts::say(std::string_view sentence, std::initializer_list<Fact> facts) {
  for (const Fact& fact : facts) object_[fact.name] = fact.value;
  while (!sentence.empty()) {
    const std::size_t open = std::min(sentence.find('{'), sentence.size());
    text_ += sentence.substr(0, open);
    sentence.remove_prefix(open);
    if (sentence.empty()) break;
    const std::size_t close = sentence.find('}');
    const std::string_view name = sentence.substr(1, close - 1);
    const auto fact = std::ranges::find(facts, name, &Fact::name);
    if (fact == facts.end()) throw std::logic_error("no fact for " + std::string(sentence));
    text_ += fact->text;
    sentence.remove_prefix(close + 1);
  }
}

void Facts::print(const Common& common) const {
  if (common.json)
    fmt::print("{}\n", object_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else if (!common.quiet)
    fmt::print("{}", text_);
}

}  // namespace sublimit::cli
