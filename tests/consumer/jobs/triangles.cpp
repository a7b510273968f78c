// Triangles within a thousandth of the limit, in memory, with normals.
#include <sublimit/sublimit.h>

#include <iostream>

int main(int, char** arguments) {
  const sublimit::LimitSurface surface(sublimit::read_mesh(arguments[1]), "catmull-clark");
  const sublimit::Tessellation near = tessellate(surface, {.chord = 1e-3});
  const sublimit::LimitSamples samples = surface.evaluate(near.places, 1);
  std::cout << near.triangles.size() << " triangles, " << samples.normal.rows() << " normals, within " << near.bound
            << "\n";
}
