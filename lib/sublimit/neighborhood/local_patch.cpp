// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/local_patch.h"

namespace sublimit {

bool is_corner(const Topology& t, const Sharpness& sharpness, Vertex v) {
  return VertexSharpness(t, sharpness, v).rule() == Rule::corner;
}

LocalType local_type(const Topology& t, const Sharpness& sharpness, const Centre& centre, int level, int period) {
  LocalType type;
  type.kind = centre.kind;
  type.phase = level % period;
  type.faces = 0;
  if (centre.kind == Centre::Kind::border || centre.kind == Centre::Kind::edge) return type;
  if (centre.kind == Centre::Kind::face) {
    type.faces = t.size(t.face(centre.start));
    return type;
  }
  HalfEdge h = centre.start;
  do {
    ++type.faces;
    const HalfEdge into = t.prev(h);
    type.open = is_cut(t, sharpness, into);
    if (type.open) break;
    h = t.twin(into);
  } while (h != centre.start);
  type.corner = is_corner(t, sharpness, t.tail(centre.start));
  return type;
}

Mesh isolated_fan(Index n, Index face_size, bool open) {
  Mesh mesh;
  const Index spokes = open ? n + 1 : n, step = face_size - 2;
  mesh.positions = Points::Zero(1 + spokes * step, 3);
  for (Index i = 0; i < n; ++i) {
    mesh.face_sizes.push_back(face_size);
    mesh.face_vertices.push_back(0);
    for (Index k = 0; k <= step; ++k)
      mesh.face_vertices.push_back(1 + (open ? i * step + k : (i * step + k) % (n * step)));
  }
  return mesh;
}

Mesh creased_fan(Index n, Index faces, Index face_size) {
  Mesh mesh = isolated_fan(n, face_size, false);
  for (const Index spoke : {Index{0}, faces % n})
    mesh.creases.push_back({0, 1 + spoke * (face_size - 2), infinite_sharpness});
  return mesh;
}

void cut_out(Level& level, Centre& centre, int rings) {
  const Topology& t = level.topology();
  const Index face = index(t.face(centre.start));
  Part around = part(level, std::span(&face, 1), rings);
  for (size_t h = 0; h < around.halves.size(); ++h)
    if (around.halves[h] == index(centre.start)) {
      centre.start = HalfEdge{static_cast<Index>(h)};
      break;
    }
  level = std::move(around.level);
}

template std::optional<LocalPatch<double>> local_patch<double>(const Scheme<double>&, LocalType, int, const Mesh*);
template std::optional<std::vector<SparsePatch<double>>> sparse_patches<double>(const Scheme<double>&, const LocalType&,
                                                                                const LocalPatchOptions&);

}  // namespace sublimit
