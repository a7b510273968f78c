// Own arrays, refined.
#include <sublimit/sublimit.h>

#include <array>
#include <cstdio>
#include <vector>

int main() {
  const std::vector<std::array<float, 3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<int, 3>> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const sublimit::Mesh fine = sublimit::refine(sublimit::make_mesh(points, triangles), "loop", 3);
  std::printf("%d points, %d faces\n", fine.num_vertices(), fine.num_faces());
}
