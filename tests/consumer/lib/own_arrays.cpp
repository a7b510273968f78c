// Meshes that are arrays already, as lib/README.md says: Eigen matrices as libigl has them, and spans that are not
// copied.
#include <sublimit/subdivide.h>

#include <vector>

using namespace sublimit;

int main() {
  // A tetrahedron, in Eigen's default column-major order.
  Eigen::MatrixXd V(4, 3);
  V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Eigen::MatrixXi F(4, 3);
  F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  const auto [S, F1] = subdivide("loop", V.rows(), F, 2);
  const Eigen::MatrixXd V1 = S * V;
  if (V1.rows() != 34 || F1.rows() != 64 || F1.cols() != 3 || !V1.allFinite()) return 1;

  // A quad and a triangle on either side of the edge (1,2).
  const std::vector<Index> corners{0, 1, 2, 3, 2, 1, 4}, sizes{4, 3};
  const Topology topology({.num_vertices = 5, .face_vertices = corners, .face_sizes = sizes});
  return topology.num_edges() == 6 && topology.faults().empty() ? 0 : 1;
}
