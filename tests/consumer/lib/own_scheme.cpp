// A scheme that the library does not have, in a program that only links it: Catmull-Clark's topology, tensor-product
// masks with weights 9/16, 3/8, 1/16 at every valence. It gets matrices and limits like any other.
#include <sublimit/limit/limit.h>
#include <sublimit/scheme/cubic_bspline_creases.h>
#include <sublimit/scheme/refine.h>

#include <cmath>
#include <cstdio>

using namespace sublimit;

template <class T>
Scheme<T> my_averaging() {
  return {
      .name = "my-averaging",
      .source = "here",
      .steps = {Step<T>{
          .split = Split::pqq,
          .masks = {
              .vertex = [](const Ring<T>& v) { return (v.center() + v.neighbor_mean() + 2 * v.face_point_mean()) / 4; },
              .edge =
                  [](const EdgeSite<T>& e) {
                    return (e.tail() + e.head() + e.left_face().point() + e.right_face().point()) / 4;
                  },
              .face = [](const FaceSite<T>& f) { return f.centroid(); }}}},
      .creases = cubic_bspline_creases<T>()};
}

int main() {
  Mesh cube;
  cube.positions.resize(8, 3);
  for (Index i = 0; i < 8; ++i) cube.positions.row(i) << (i & 1 ? 1 : -1), (i & 2 ? 1 : -1), (i & 4 ? 1 : -1);
  cube.face_sizes = {4, 4, 4, 4, 4, 4};
  cube.face_vertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  const Scheme<double> scheme = my_averaging<double>();
  const std::vector<Level> levels = refine(scheme, cube, 2);
  const Limit limit = sublimit::limit(cube, scheme);
  const Eigen::RowVector3d corner = limit.points.row(7), normal = limit.normals.row(0);
  std::printf("%td points on level 2; the corner's limit is (%g, %g, %g)\n", levels[2].S.rows(), corner[0], corner[1],
              corner[2]);
  const bool symmetric = std::abs(corner[0] - corner[1]) < 1e-12 && std::abs(corner[0] - corner[2]) < 1e-12;
  return symmetric && corner[0] > 0 && corner[0] < 1 && std::abs(normal.norm() - 1) < 1e-12 ? 0 : 1;
}
