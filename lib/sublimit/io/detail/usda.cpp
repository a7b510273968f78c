// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usda.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr int deepest = 500;  // prims in prims, far more than scenes have; each takes a part of the stack

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (static_cast<unsigned char>(c) & 0x80) != 0;
}
std::string key_of(std::string_view name, std::string_view part) { return std::string(name) + "." + std::string(part); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// The end of a comment that begins at `at`; `at` if none does.
std::size_t skip_comment(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with('#') || rest.starts_with("//")) return std::min(text.find('\n', at), text.size());
  if (rest.starts_with("/*")) {
    const std::size_t end = text.find("*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
  }
  return at;
}

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    if (is_space(text[at])) {
      ++at;
    } else {
      const std::size_t behind = skip_comment(text, at);
      if (behind == at) break;
      at = behind;
    }
  }
  return at;
}

/// The end of a text in quotes, of which three in a row hold line ends.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.substr(at, 3) == three;
  for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (is_long) {
      if (text.substr(i, 3) == three) return i + 3;
    } else if (text[i] == quote) {
      return i + 1;
    } else if (text[i] == '\n') {
      return std::string_view::npos;
    }
  }
  return std::string_view::npos;
}

std::size_t end_of_asset(std::string_view text, std::size_t at) {
  const bool is_long = text.substr(at, 3) == "@@@";
  const std::size_t end = text.find(is_long ? "@@@" : "@", at + (is_long ? 3 : 1));
  return end == std::string_view::npos ? std::string_view::npos : end + (is_long ? 3 : 1);
}

/// The end of a group in brackets.
std::size_t end_of_group(std::string_view text, std::size_t at) {
  std::string open;  // brackets that are to be closed, innermost last
  while (at < text.size()) {
    const char c = text[at];
    if (c == '(' || c == '[' || c == '{') {
      open += c == '(' ? ')' : c == '[' ? ']' : '}';
      ++at;
    } else if (c == ')' || c == ']' || c == '}') {
      if (open.empty() || open.back() != c) return std::string_view::npos;
      open.pop_back();
      ++at;
      if (open.empty()) return at;
    } else if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
    } else if (c == '@') {
      at = end_of_asset(text, at);
    } else if (c == '#' || c == '/') {
      at = std::max(at + 1, skip_comment(text, at));
    } else if (c == '<') {
      at = text.find('>', at);
    } else {
      ++at;
    }
    if (at == std::string_view::npos) return std::string_view::npos;
  }
  return std::string_view::npos;
}

class UsdaReader {
 public:
  explicit UsdaReader(UsdLayer& layer) : layer_(layer), text_(layer.text) {}

  void read() {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    if (!text_.substr(at_).starts_with("#usda")) fail(at_, "the file should begin with '#usda 1.0'");
    at_ = skip_space(text_, at_);
    UsdSpec& root = layer_.root;
    root.text = root.body = text_;
    if (looks_at('(')) read_metadata(root.metadata);
    read_contents(root, 0);
    if (at_ < text_.size()) fail(at_, "'}' without '{'");
  }

 private:
  [[noreturn]] void fail(std::size_t at, const std::string& what) const {
    throw FormatError(layer_.place(text_.substr(std::min(at, text_.size()), 0)) + what);
  }

  void skip() { at_ = skip_space(text_, at_); }
  void skip_separators() {
    for (skip(); at_ < text_.size() && text_[at_] == ';'; skip()) ++at_;
  }
  bool looks_at(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) {
    if (!looks_at(c)) return false;
    ++at_;
    return true;
  }
  void expect(char c, const char* after) {
    skip();
    if (!take(c)) fail(at_, std::string("'") + c + "' should follow " + after + ", not " + what_is_here());
  }
  std::string what_is_here() const {
    if (at_ >= text_.size()) return "the end of the file";
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_word_character(text_[at_]) && is_word_character(text_[end])) ++end;
    return in_quotes(text_.substr(at_, end - at_));
  }

  /// The next word; empty if there is none. Words have what `is_more` allows besides letters and digits.
  std::string_view word(std::string_view more = {}) {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_word_character(text_[at_]) || more.find(text_[at_]) != std::string_view::npos))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  /// Takes the next word if it is this one.
  bool take_word(std::string_view wanted) {
    const std::size_t before = at_;
    if (word(":") == wanted) return true;
    at_ = before;
    return false;
  }
  std::string_view take_edit() {
    for (const std::string_view edit : {"prepend", "append", "add", "delete", "reorder"})
      if (take_word(edit)) return edit;
    return {};
  }

  std::string_view value(const char* of) {
    skip();
    const std::size_t begin = at_, end = end_of_usd_value(text_, at_);
    if (end == std::string_view::npos) fail(begin, std::string("the value of ") + of + " that begins here has no end");
    if (end == begin) fail(begin, std::string("a value of ") + of + " should be here, not " + what_is_here());
    at_ = end;
    return text_.substr(begin, end - begin);
  }

  std::string_view name_in_quotes(const char* of) {
    skip();
    const std::size_t begin = at_;
    if (!looks_at('"') && !looks_at('\'')) fail(at_, std::string("the name of ") + of + " should be here, in quotes");
    at_ = end_of_string(text_, at_);
    if (at_ == std::string_view::npos) fail(begin, std::string("the name of ") + of + " has no end");
    return text_.substr(begin + 1, at_ - begin - 2);
  }

  /// ( "a comment", key = value, ... )
  void read_metadata(std::vector<UsdField>& fields) {
    const std::size_t begin = at_++;
    for (skip_separators(); !take(')'); skip_separators()) {
      if (at_ >= text_.size()) fail(begin, "metadata that begin here have no end");
      UsdField field;
      if (looks_at('"') || looks_at('\'')) {
        field.value = value("metadata");
      } else {
        field.edit = take_edit();
        field.key = word(":");
        if (field.key.empty()) fail(at_, "a key of metadata should be here, not " + what_is_here());
        skip();
        if (take('=')) field.value = reference(value("metadata"));
      }
      fields.push_back(field);
    }
  }

  /// A path and a group may stand behind the file of a reference, @a.usda@</A> (offset = 1).
  std::string_view reference(std::string_view first) {
    const std::size_t begin = static_cast<std::size_t>(first.data() - text_.data());
    std::size_t end = at_;
    if (first[0] != '@' && first[0] != '<') return first;
    for (const char next : {'<', '('}) {
      skip();
      if (!looks_at(next) || (next == '<' && first[0] == '<')) continue;
      value("metadata");
      end = at_;
    }
    at_ = end;
    return text_.substr(begin, end - begin);
  }

  /// Prims, properties and variants, until a brace closes or the file ends.
  void read_contents(UsdSpec& spec, int depth) {
    if (depth > deepest) fail(at_, "prims are in more than " + format_number(deepest) + " others");
    for (skip_separators(); at_ < text_.size() && !looks_at('}'); skip_separators()) {
      const std::size_t begin = at_;
      const std::string_view first = word(":");
      if (first == "def" || first == "over" || first == "class") {
        read_prim(spec.children.emplace_back(UsdSpec{.specifier = first}), begin, depth);
      } else if (first == "variantSet") {
        read_variants(spec, depth);
      } else if (first == "reorder" &&
                 (take_word("nameChildren") || take_word("properties") || take_word("rootPrims"))) {
        expect('=', "what is reordered");
        value("an order");
      } else {
        at_ = begin;
        read_property(spec, depth);
      }
    }
  }

  void read_prim(UsdSpec& prim, std::size_t begin, int depth) {
    skip();
    if (!looks_at('"') && !looks_at('\'')) prim.type = word(":");
    prim.name = name_in_quotes("a prim");
    skip();
    if (looks_at('(')) read_metadata(prim.metadata);
    read_body(prim, "the prim", depth);
    prim.text = text_.substr(begin, at_ - begin);
  }

  void read_body(UsdSpec& spec, const char* what, int depth) {
    expect('{', what);
    const std::size_t begin = at_;
    read_contents(spec, depth + 1);
    if (!looks_at('}')) fail(begin, std::string("the brace of ") + what + " that opens here is not closed");
    spec.body = text_.substr(begin, at_ - begin);
    ++at_;
    constexpr std::size_t many = 64;
    if (spec.properties.size() >= many)
      for (std::size_t i = 0; i < spec.properties.size(); ++i)
        spec.by_name[key_of(spec.properties[i].name, spec.properties[i].part)] = i;
  }

  /// "name" = { "variant" { ... } ... }
  void read_variants(UsdSpec& spec, int depth) {
    const std::string_view set = name_in_quotes("a set of variants");
    expect('=', "the name of a set of variants");
    expect('{', "'='");
    for (skip_separators(); !take('}'); skip_separators()) {
      if (at_ >= text_.size()) fail(at_, "the variants of '" + std::string(set) + "' have no end");
      UsdSpec& variant = spec.variants.emplace_back();
      variant.specifier = "over";
      variant.set = set;
      const std::size_t begin = at_;
      variant.name = name_in_quotes("a variant");
      skip();
      if (looks_at('(')) read_metadata(variant.metadata);
      read_body(variant, "the variant", depth);
      variant.text = text_.substr(begin, at_ - begin);
    }
  }

  /// [edit] [custom] [uniform | varying | config] type name[.part] [= value] [(metadata)]
  void read_property(UsdSpec& spec, int depth) {
    UsdProperty property;
    const std::size_t begin = at_;
    property.edit = take_edit();
    take_word("custom");
    property.uniform = take_word("uniform");
    if (!property.uniform && !take_word("varying")) take_word("config");
    property.type = word(":");
    if (property.type.empty())
      fail(at_, std::string(depth > 0 ? "a property or a prim" : "a prim") + " should be here, not " + what_is_here());
    const std::size_t type_begin = static_cast<std::size_t>(property.type.data() - text_.data());
    if (const std::size_t at = skip_space(text_, at_); text_.substr(at, 1) == "[") {
      at_ = at + 1;
      expect(']', "'[' of a type");
      property.type = text_.substr(type_begin, at_ - type_begin);
    }
    std::string_view name = word(":.|");
    if (name.empty())
      fail(at_,
           "the name of a property of type " + in_quotes(property.type) + " should be here, not " + what_is_here());
    property.name = name.substr(0, name.find('.'));
    property.part = name.substr(std::min(property.name.size() + 1, name.size()));
    std::size_t end = at_;
    skip();
    if (take('=')) {
      property.value = value("a property");
      end = at_;
      skip();
    }
    if (looks_at('(')) {
      read_metadata(property.metadata);
      end = at_;
    }
    at_ = end;
    property.text = text_.substr(begin, end - begin);
    spec.properties.push_back(std::move(property));
  }

  UsdLayer& layer_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

const UsdField* UsdSpec::field(std::string_view key) const {
  const auto found = std::ranges::find(metadata, key, &UsdField::key);
  return found == metadata.end() ? nullptr : &*found;
}

const UsdProperty* UsdSpec::property(std::string_view named, std::string_view part) const {
  if (!by_name.empty()) {
    const auto found = by_name.find(key_of(named, part));
    return found == by_name.end() ? nullptr : &properties[found->second];
  }
  const auto found = std::find_if(properties.rbegin(), properties.rend(), [&](const UsdProperty& property) {
    return property.name == named && property.part == part;
  });
  return found == properties.rend() ? nullptr : &*found;
}

const UsdSpec* find_usd_spec(const UsdSpec& root, std::string_view path) {
  const UsdSpec* spec = &root;
  while (spec && path.size() > 1) {
    path.remove_prefix(1);
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view name = path.substr(0, end);
    const auto found = std::ranges::find(spec->children, name, &UsdSpec::name);
    spec = found == spec->children.end() ? nullptr : &*found;
    path.remove_prefix(end);
  }
  return spec;
}

std::string UsdLayer::place(std::string_view part) const {
  const auto before = static_cast<std::size_t>(part.data() - text.data());
  return name + ":" + format_number(1 + (std::ranges::lower_bound(lines, before) - lines.begin())) + ": ";
}

std::shared_ptr<const UsdLayer> parse_usda(std::string text, std::string name) {
  require_text(text, name, "USD");
  auto layer = std::make_shared<UsdLayer>();
  layer->name = std::move(name);
  layer->text = std::move(text);
  for (std::size_t at = 0; (at = layer->text.find('\n', at)) != std::string_view::npos; ++at)
    layer->lines.push_back(at);
  UsdaReader(*layer).read();
  return layer;
}

std::size_t end_of_usd_value(std::string_view text, std::size_t at) {
  if (at >= text.size()) return at;
  const char c = text[at];
  if (c == '"' || c == '\'') return end_of_string(text, at);
  if (c == '@') return end_of_asset(text, at);
  if (c == '<') {
    const std::size_t end = text.find('>', at);
    return end == std::string_view::npos ? std::string_view::npos : end + 1;
  }
  if (c == '(' || c == '[' || c == '{') return end_of_group(text, at);
  while (at < text.size() &&
         (is_word_character(text[at]) || std::string_view("+-.:|").find(text[at]) != std::string_view::npos))
    ++at;
  return at;
}

}  // namespace sublimit
