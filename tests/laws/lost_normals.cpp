// SPDX-License-Identifier: Apache-2.0
#include "laws/lost_normals.h"

#include <algorithm>

namespace sublimit::testing {

const std::vector<LostNormals>& lost_normals() {
  using enum LostNormals::Where;
  static const std::string own = "every edge at the vertex shrinks by 1/2 for itself, and they are three or more";
  static const std::string tied =
      "two modes of 1/4 beside the one along the border: with one or two faces control points take both in the same "
      "direction (LimitMasks::Plane::tied), with more they need not. That there are two is exact, of middles of border "
      "edges; that limits show both, and control points of three faces take them apart, is not";
  static const std::string slow = "modes of the inside shrink no faster than the one along the border";
  static const std::string odd =
      "the first mode of the inside is odd under the mirror, like the one along the border: the surface folds there";
  static const std::string both_sides =
      "the first mode of the inside is on both sides of the border; where it is even (7 to 9 faces) that is evidence: "
      "the surface could go around twice, and whether it does is not looked at";
  static const std::vector<LostNormals> all{
      {"bilinear", inside, 2, 0, false, true, own},
      {"bilinear", border, 2, 0, false, true, own},
      {"bilinear", corner, 2, 0, false, true, own},
      {"mid-edge", border, 3, 0, true, false, tied},
      {"mid-edge-habib-warren", border, 3, 0, true, false, tied},
      {"butterfly", inside, 3, 3, false, true, "block 0 shrinks no faster than block 1"},
      {"butterfly", inside, 8, 0, false, true, "block 2 shrinks no faster than block 1, which the modification mends"},
      {"butterfly", border, 4, 6, false, true, odd},
      {"butterfly", border, 7, 0, false, false, both_sides},
      {"modified-butterfly", border, 4, 6, false, true, odd},
      {"modified-butterfly", border, 7, 0, false, false, both_sides},
      {"kobbelt", border, 3, 0, false, true, slow},
  };
  return all;
}

bool has_no_normal(const Scheme<double>& scheme, const NormalPlace& place) {
  using enum LostNormals::Where;
  const LostNormals::Where where = !place.one_sided ? inside : place.corner ? corner : border;
  return std::ranges::any_of(lost_normals(), [&](const LostNormals& row) {
    const Index faces = row.before ? place.from_faces : place.faces;
    return row.scheme == scheme.name && row.where == where && faces >= row.least &&
           (row.most == 0 || faces <= row.most);
  });
}

}  // namespace sublimit::testing
