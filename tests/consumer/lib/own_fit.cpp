// A mesh whose limit has vertices at given points, one of them with a given normal, by sublimit.h.
#include <sublimit/sublimit.h>

#include <iostream>

using namespace sublimit;

int main() {
  // A cube from (0,0,0) to (1,1,1); the limits of its vertices 0 and 5 are given, for 0 a normal too.
  Points corners(8, 3);
  for (int v = 0; v < 8; ++v) corners.row(v) << (v & 1), (v >> 1 & 1), (v >> 2 & 1);
  const Mesh cage = make_mesh(corners, std::vector<Index>(6, 4),
                              {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5});
  const Eigen::Vector3d p(-0.1, 0, 0), n(-1, -1, -2), q(1, 0.25, 1);
  const Fit fit =
      sublimit::fit(cage, "catmull-clark", {{.vertex = 0, .position = p, .normal = n}, {.vertex = 5, .position = q}});
  if (!fit.solved) return std::cerr << fit.why_not << "\n", 1;
  const Limit limit = sublimit::limit(fit.mesh, "catmull-clark");
  std::cout << limit.points.topRows(8) << "\n" << limit.normals.row(0) << "\n";
  const double position = (limit.points.row(0).transpose() - p).norm() + (limit.points.row(5).transpose() - q).norm();
  return position < 1e-13 && (limit.normals.row(0).transpose() - n.normalized()).norm() < 1e-12 ? 0 : 1;
}
