// A mesh whose limit has two vertices where they are wanted.
#include <sublimit/sublimit.h>

#include <iostream>

int main(int, char** arguments) {
  const sublimit::Mesh mesh = sublimit::read_mesh(arguments[1]);
  const sublimit::Fit fit = sublimit::fit(
      mesh, "catmull-clark", {{.vertex = 0, .position = {-1, -1, -1}}, {.vertex = 6, .position = {1, 1, 1}}});
  if (!fit.solved) return std::cerr << fit.why_not << "\n", 1;
  sublimit::write_mesh("fitted.obj", fit.mesh);
}
