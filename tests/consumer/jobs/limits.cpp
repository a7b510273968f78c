// Limits of a file's vertices, with their normals.
#include <sublimit/sublimit.h>

#include <iostream>

int main(int, char** arguments) {
  const sublimit::Mesh mesh = sublimit::read_mesh(arguments[1]);
  const sublimit::Limit limit = sublimit::limit(mesh, "catmull-clark");
  for (sublimit::Index side = 0; side < limit.normals.rows(); ++side)  // a vertex has several where creases meet
    std::cout << limit.points.row(limit.side_vertex[side]) << "  " << limit.normals.row(side) << "\n";
}
