// Nearest points, and where rays hit.
#include <sublimit/sublimit.h>

#include <iostream>

int main(int, char** arguments) {
  const sublimit::LimitSurface surface(sublimit::read_mesh(arguments[1]), "catmull-clark");
  sublimit::Points queries(2, 3);
  queries << 2, 0, 0, 0.1, 0.2, 0.3;
  const sublimit::ClosestPoints near = closest(surface, queries, {.is_signed = true});
  const sublimit::RayHits hits =
      intersect(surface, {{.origin = {5, 0.1, 0.1}, .direction = {-1, 0, 0}}}, {.all = true});
  std::cout << near.points << "\n" << near.distances.transpose() << "\n" << hits.points << "\n";
}
