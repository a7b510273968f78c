// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/obj_tags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/edge_lookup.h"

namespace sublimit {

/// The arguments of a tag, split by the counts in front of them.
struct ObjTags::Arguments {
  std::string name;
  std::vector<std::string_view> ints, floats, strings;
};

namespace {

[[noreturn]] void malformed(const TextScanner& scanner, std::string_view name, const std::string& what,
                            std::string_view right) {
  throw FormatError(scanner.place() + "tag '" + std::string(name) + "' " + what + "; it should be '" +
                    std::string(right) + "'");
}

// "2/1/0": how many integers, floats and strings follow.
std::array<std::int64_t, 3> parse_counts(const TextScanner& scanner, std::string_view name, std::string_view token,
                                         std::string_view right) {
  std::array<std::int64_t, 3> counts{};
  std::string_view rest = token;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find('/') : rest.size();
    const Parsed<std::int64_t> count = parse_number<std::int64_t>(rest.substr(0, end));
    if (end == std::string_view::npos || !count || count.value < 0) {
      malformed(scanner, name, "has " + in_quotes(token) + " where its counts of arguments should be", right);
    }
    counts[i] = count.value;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return counts;
}

float sharpness(const TextScanner& scanner, std::string_view token) {
  const float value = scanner.real_float(token, "sharpness");
  if (value >= 0) return value;
  throw FormatError(scanner.place() + "sharpness is " + in_quotes(token) +
                    "; it should be 0 or more, where 10 and above are infinitely sharp");
}

Index id(const TextScanner& scanner, std::string_view token, const char* what) {
  const std::int64_t value = scanner.integer(token, what);
  if (value >= 0 && value <= std::numeric_limits<Index>::max()) return static_cast<Index>(value);
  throw InvalidMesh(scanner.place() + what + " " + in_quotes(token) + " is out of range; ids in tags count from 0");
}

// One of `values`, by an integer.
template <class T, std::size_t n>
T choice(const TextScanner& scanner, std::string_view token, const std::array<T, n>& values, const char* what) {
  const std::int64_t value = scanner.integer(token, what);
  if (value >= 0 && value < std::int64_t{n}) return values[static_cast<std::size_t>(value)];
  throw FormatError(scanner.place() + what + " is " + in_quotes(token) + "; it should be 0 to " + format_number(n - 1));
}

// One of two values, by name.
template <class T>
T choice(const TextScanner& scanner, std::string_view token, const char* first, T value, const char* second, T other) {
  if (token == first) return value;
  if (token == second) return other;
  throw FormatError(scanner.place() + "unknown value " + in_quotes(token) + "; it should be '" + first + "' or '" +
                    second + "'");
}

struct TagForm {
  std::string_view name;
  std::string_view right;     // an example
  int ints, floats, strings;  // how many there must be; -1: any number
};
constexpr TagForm forms[] = {
    {"crease", "t crease 2/1/0 VERTEX VERTEX SHARPNESS", -1, -1, 0},
    {"corner", "t corner 1/1/0 VERTEX SHARPNESS", -1, -1, 0},
    {"hole", "t hole 1/0/0 FACE", -1, 0, 0},
    {"knotinterval", "t knotinterval 2/1/0 VERTEX VERTEX INTERVAL", 2, 1, 0},
    {"interpolateboundary", "t interpolateboundary 1/0/0 0|1|2", 1, 0, 0},
    {"creasemethod", "t creasemethod 0/0/1 normal|chaikin", 0, 0, 1},
    {"smoothtriangles", "t smoothtriangles 0/0/1 catmark|smooth", 0, 0, 1},
    {"facevaryinginterpolateboundary", "t facevaryinginterpolateboundary 1/0/0 0|1|2|3|4|5", 1, 0, 0},
    {"facevaryingpropagatecorners", "t facevaryingpropagatecorners 1/0/0 0|1", 1, 0, 0},
};

void require_counts(const TextScanner& scanner, const TagForm& form, const std::array<std::int64_t, 3>& counts) {
  const auto fits = [](int wanted, std::int64_t count) { return wanted < 0 || wanted == count; };
  bool ok = fits(form.ints, counts[0]) && fits(form.floats, counts[1]) && fits(form.strings, counts[2]);
  if (form.floats < 0) {  // one sharpness for all, or one each
    const std::int64_t each = form.name == "crease" ? 2 : 1;
    ok = ok && counts[0] >= each && counts[0] % each == 0 && (counts[1] == 1 || counts[1] == counts[0] / each);
  }
  if (ok) return;
  malformed(scanner, form.name,
            "cannot have " + format_number(counts[0]) + " integers, " + format_number(counts[1]) + " floats and " +
                format_number(counts[2]) + " strings",
            form.right);
}

}  // namespace

void ObjTags::read(TextScanner& scanner, Mesh& mesh) {
  Arguments arguments{.name = std::string(scanner.token()), .ints = {}, .floats = {}, .strings = {}};
  const std::string& name = arguments.name;
  if (name.empty()) malformed(scanner, name, "has no name", "t NAME INTS/FLOATS/STRINGS ...");
  if (name == "vertexedit" || name == "edgeedit" || name == "faceedit") {
    return skip(scanner, name, "hierarchical edits are not supported", mesh);
  }
  const TagForm* form =
      std::find_if(std::begin(forms), std::end(forms), [&](const TagForm& f) { return f.name == name; });
  if (form == std::end(forms)) return skip(scanner, name, "unknown tag", mesh);

  const std::array<std::int64_t, 3> counts = parse_counts(scanner, name, scanner.token(), form->right);
  require_counts(scanner, *form, counts);
  std::vector<std::string_view>* const lists[] = {&arguments.ints, &arguments.floats, &arguments.strings};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::int64_t k = 0; k < counts[i]; ++k) {  // ends with the line at the latest
      const std::string_view token = scanner.token();
      if (token.empty()) malformed(scanner, name, "has fewer arguments than its counts say", form->right);
      lists[i]->push_back(token);
    }
  }
  if (!scanner.token().empty()) malformed(scanner, name, "has more arguments than its counts say", form->right);

  if (name == "crease") return read_crease(scanner, arguments, mesh);
  if (name == "corner") return read_corner(scanner, arguments, mesh);
  if (name == "hole") return read_hole(scanner, arguments, mesh);
  if (name == "knotinterval") return read_knot_interval(scanner, arguments, mesh);
  if (name == "interpolateboundary") {
    constexpr std::array values{Boundary::none, Boundary::edge_and_corner, Boundary::edge_only};
    mesh.boundary = choice(scanner, arguments.ints[0], values, "interpolateboundary");
  } else if (name == "creasemethod") {
    mesh.creasing = choice(scanner, arguments.strings[0], "normal", Creasing::uniform, "chaikin", Creasing::chaikin);
  } else if (name == "smoothtriangles") {
    mesh.triangles = choice(scanner, arguments.strings[0], "catmark", Triangles::catmark, "smooth", Triangles::smooth);
  } else if (name == "facevaryinginterpolateboundary") {
    using enum FaceVaryingInterpolation;
    constexpr std::array values{none, corners_only, corners_plus1, corners_plus2, boundaries, all};
    mesh.face_varying_interpolation = choice(scanner, arguments.ints[0], values, "facevaryinginterpolateboundary");
  } else {
    choice(scanner, arguments.ints[0], std::array{0, 1}, "facevaryingpropagatecorners");
  }
}

void ObjTags::read_crease(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh) {
  for (std::size_t i = 0; 2 * i < arguments.ints.size(); ++i) {
    mesh.creases.push_back({.tail = id(scanner, arguments.ints[2 * i], "vertex"),
                            .head = id(scanner, arguments.ints[2 * i + 1], "vertex"),
                            .sharpness = sharpness(scanner, arguments.floats[arguments.floats.size() > 1 ? i : 0])});
    crease_lines_.push_back(scanner.line());
  }
}

void ObjTags::read_corner(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh) {
  for (std::size_t i = 0; i < arguments.ints.size(); ++i) {
    mesh.corners.push_back({.vertex = id(scanner, arguments.ints[i], "vertex"),
                            .sharpness = sharpness(scanner, arguments.floats[arguments.floats.size() > 1 ? i : 0])});
    corner_lines_.push_back(scanner.line());
  }
}

void ObjTags::read_hole(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh) {
  for (const std::string_view face : arguments.ints) {
    mesh.holes.push_back(id(scanner, face, "face"));
    hole_lines_.push_back(scanner.line());
  }
}

void ObjTags::read_knot_interval(const TextScanner& scanner, const Arguments& arguments, Mesh& mesh) {
  const double length = scanner.real(arguments.floats[0], "knot interval");
  if (!std::isfinite(length) || length < 0)
    throw FormatError(scanner.place() + "knot interval is " + in_quotes(arguments.floats[0]) +
                      "; it should be a positive number");
  mesh.knot_intervals.push_back({.tail = id(scanner, arguments.ints[0], "vertex"),
                                 .head = id(scanner, arguments.ints[1], "vertex"),
                                 .length = length});
  interval_lines_.push_back(scanner.line());
}

void ObjTags::skip(const TextScanner& scanner, std::string_view name, const char* why, Mesh& mesh) {
  constexpr std::size_t most = 20;
  if (skipped_.size() >= most || std::find(skipped_.begin(), skipped_.end(), name) != skipped_.end()) return;
  skipped_.emplace_back(name);
  mesh.warnings.push_back(scanner.place() + "tag " + in_quotes(name) + " ignored: " + why);
  if (skipped_.size() == most) mesh.warnings.push_back(scanner.place() + "further unknown tags are not listed");
}

void ObjTags::settle(const TextScanner& scanner, Mesh& mesh) const {
  const auto check_id = [&](std::int64_t line, const char* tag, const char* what, Index id, Index count) {
    if (id < count) return;
    throw InvalidMesh(scanner.place(line) + tag + ": " + what + " " + format_number(id) +
                      " is out of range; the mesh has " + format_number(count) + " (ids in tags are 0 to " +
                      format_number(count - 1) + ")");
  };
  for (std::size_t i = 0; i < mesh.creases.size(); ++i) {
    check_id(crease_lines_[i], "crease", "vertex", mesh.creases[i].tail, mesh.num_vertices());
    check_id(crease_lines_[i], "crease", "vertex", mesh.creases[i].head, mesh.num_vertices());
  }
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    check_id(corner_lines_[i], "corner", "vertex", mesh.corners[i].vertex, mesh.num_vertices());
  }
  for (std::size_t i = 0; i < mesh.holes.size(); ++i) {
    check_id(hole_lines_[i], "hole", "face", mesh.holes[i], mesh.num_faces());
  }
  for (std::size_t i = 0; i < mesh.knot_intervals.size(); ++i) {
    check_id(interval_lines_[i], "knotinterval", "vertex", mesh.knot_intervals[i].tail, mesh.num_vertices());
    check_id(interval_lines_[i], "knotinterval", "vertex", mesh.knot_intervals[i].head, mesh.num_vertices());
  }
  const std::vector<Mesh::Crease> interval_edges = edges_of(mesh.knot_intervals);
  const std::vector<bool> measured = along_edges(mesh, interval_edges);
  if (const auto missing = std::ranges::find(measured, false); missing != measured.end()) {
    const auto i = static_cast<std::size_t>(missing - measured.begin());
    throw InvalidMesh(scanner.place(interval_lines_[i]) + "knotinterval: no face has an edge between vertices " +
                      format_number(interval_edges[i].tail) + " and " + format_number(interval_edges[i].head) +
                      "; an interval is of an edge (ids in tags count from 0)");
  }
  drop_loose_creases(mesh, [&](std::size_t i) { return scanner.place(crease_lines_[i]); });
}

}  // namespace sublimit
