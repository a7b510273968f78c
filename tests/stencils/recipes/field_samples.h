// SPDX-License-Identifier: Apache-2.0
#pragma once
// A small field of each kind as a JSON document, and damaged documents.
#include <random>
#include <regex>
#include <string>
#include <vector>

namespace sublimit::testing {

/// Returns a document for every kind of field, each with a closed surface in the box from (-2, -2, -2) to (2,
/// 2, 2).
inline const std::vector<std::string>& field_documents() {
  static const std::string ball = R"({"field": "distance-point", "point": [0, 0, 0], "radius": "1/2"})";
  static const std::string box = R"(, "box": [[-2, -2, -2], [2, 2, 2]]})";
  static const std::string both =
      R"("of": [{"field": "box", "center": [0, 0, 0], "half": [1, 0.9, 0.8]}, )" + ball + "]";
  static const std::string blob = R"([{"center": [0.5, 0.25, 0], "height": 3, )";
  static const std::vector<std::string> all{
      R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})",
      R"({"field": "distance-point", "point": [0, 0, 0], "radius": "1/2"})",
      R"({"field": "distance-segment", "from": [0, 0, 0], "to": [1, 0, 0], "radius": 0.5})",
      R"({"field": "distance-circle", "center": [0, 0, 0], "normal": [0, 0, 1], "ring": 1, "radius": 0.5})",
      R"({"field": "distance-polygon", "points": [[0, 0], [1, 0], [1, 1], [0, 1]], "radius": 0.5})",
      R"({"field": "box", "center": [0, 0, 0], "half": [1, 0.75, 0.5]})",
      R"({"field": "polynomial", "terms": [[1, 2, 0, 0], [1, 0, 2, 0], [2, 0, 0, 2], [-1, 0, 0, 0]])" + box,
      R"({"field": "blinn", "threshold": 1, "blobs": )" + blob + R"("decay": 2}]})",
      R"({"field": "metaballs", "threshold": 1, "blobs": )" + blob + R"("radius": 1}]})",
      R"({"field": "soft-objects", "threshold": 1, "blobs": )" + blob + R"("radius": 1}]})",
      R"({"field": "union", )" + both + "}",
      R"({"field": "intersection", )" + both + "}",
      R"({"field": "difference", )" + both + "}",
      R"({"field": "smooth-union", "width": 0.25, )" + both + "}",
      R"({"field": "offset", "by": 0.25, "of": )" + ball + "}",
      R"({"field": "transformed", "matrix": [[0,-2,0,0.5],[2,0,0,0.25],[0,0,2,0.125],[0,0,0,1]], "of": )" + ball + "}",
      R"({"field": "intersection", "of": [{"field": "distance-line", "point": [0, 0, 0], "direction": [0, 0, 1],)"
      R"( "radius": 0.75}, {"field": "distance-plane", "point": [0, 0, 0], "normal": [0, 0, 1], "offset": 0.5}], "box": [[-2, -2, -2], [2, 2, 2]]})"};
  return all;
}

/// Returns a document with a number, a word or a few bytes changed.
inline std::string spoilt(const std::string& document, std::mt19937& random) {
  static const std::vector<std::string> instead{"0",
                                                "-1",
                                                "1e-300",
                                                "1e300",
                                                "-1e300",
                                                "1e308",
                                                "1e999",
                                                "\"1/3\"",
                                                "\"1/0\"",
                                                "null",
                                                "true",
                                                "[]",
                                                "{}",
                                                "[1]",
                                                "[[1]]",
                                                "\"\"",
                                                "\"sphere\"",
                                                "\"of\"",
                                                "99999999999999999999",
                                                "0.1",
                                                "3",
                                                "NaN",
                                                "-0.0"};
  const auto pick = [&](size_t count) { return size_t(random() % count); };
  std::string text = document;
  if (pick(3) > 0) {
    static const std::regex word(R"re(-?[0-9][0-9.e+-]*|"[^"]*")re");
    const std::vector<std::smatch> words(std::sregex_iterator(document.begin(), document.end(), word), {});
    const std::smatch& chosen = words[pick(words.size())];
    return text.replace(size_t(chosen.position()), size_t(chosen.length()), instead[pick(instead.size())]);
  }
  static const std::string bytes = "{}[]\",:01-9.eE \n\\\x01\xff";
  for (size_t i = 1 + pick(3); i > 0 && !text.empty(); --i) {
    const size_t at = pick(text.size());
    switch (pick(4)) {
      case 0:
        text.erase(at, 1 + pick(8));
        break;
      case 1:
        text.insert(at, 1, bytes[pick(bytes.size())]);
        break;
      case 2:
        text[at] = bytes[pick(bytes.size())];
        break;
      default:
        text.insert(pick(text.size()), text.substr(at, 1 + pick(40)));
    }
  }
  return text;
}

}  // namespace sublimit::testing
