// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/made_by.h"

#include <algorithm>
#include <exception>
#include <new>
#include <set>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/submatrix.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/same_scheme.h"
#include "sublimit/scheme/detail/subdivision_rows.h"

namespace sublimit {
namespace {

Scheme<double> without_preparation(Scheme<double> scheme) {
  scheme.preparation.clear();
  return scheme;
}

/// Rows of S around a face: those of all children of its part or, where a vertex of many faces makes that large, those
/// of the face's own children. Next to such a vertex every row may be as long as there are faces.
SparseMatrix rows_around(const Scheme<double>& scheme, const Part& around, Index face) {
  constexpr Index many = 512;  // faces; parts of regular meshes have up to some hundred
  if (scheme.steps.size() > 1 || around.level.topology().num_faces() <= many) return next_level(scheme, around.level).S;
  const Level child = next_topology(scheme, around.level, [](const auto&...) {});
  const auto own =
      static_cast<Index>(std::lower_bound(around.faces.begin(), around.faces.end(), face) - around.faces.begin());
  const Topology& t = child.topology();
  std::set<Index> vertices;
  for (Index f = 0; f < t.num_faces(); ++f)
    if (child.steps[0].face_parent[f] == own)
      for (const Index v : t.vertices(Face{f})) vertices.insert(v);
  return subdivision_rows(scheme, around.level, child, std::vector<Index>(vertices.begin(), vertices.end()));
}

std::string title(const Scheme<double>& scheme) {
  std::string text = "'" + scheme.name + "'";
  for (const auto& [name, value] : scheme.chosen) text += " " + name + "=" + value;
  return text;
}

}  // namespace

bool is_same_scheme(const Scheme<double>& a, const Scheme<double>& b, const Level& level) {
  if (!is_alike(a, b)) return false;
  const Scheme<double> first = without_preparation(a), second = without_preparation(b);
  const Index faces = level.topology().num_faces();
  if (faces == 0) return true;
  for (const Index face : std::set<Index>{0, faces / 3, faces - faces / 3 - 1, faces - 1}) {
    constexpr int enough = 4;  // for rows that are the mesh's; beyond both schemes see the same rim
    const Part around = part(level, std::span(&face, 1), enough);
    if (second.corners && around.level.topology().uniform_face_size() != second.corners) continue;  // to be prepared
    try {
      if (!has_same_bits(rows_around(first, around, face), rows_around(second, around, face))) return false;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      return true;  // what is wrong here the limit itself meets, and says it of the whole level
    }
  }
  return true;
}

void check_same_scheme(const Scheme<double>& scheme, const Scheme<double>& own, const Level& level,
                       const std::string& what) {
  if (is_same_scheme(scheme, own, level)) return;
  const std::string one = title(scheme), other = title(own);
  throw InvalidParameter(what + " is of the scheme " + other + ", but the level that it meets was made by " +
                         (one == other ? "a scheme of this name with other masks" : one) +
                         "; take one scheme for both");
}

void check_made_by(const Level& level, const Scheme<double>& scheme, const std::string& what) {
  if (level.made_by) check_same_scheme(*level.made_by, scheme, level, what);
}

}  // namespace sublimit
