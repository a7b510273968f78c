// A million places of the limit, with curvature.
#include <sublimit/sublimit.h>

#include <algorithm>
#include <iostream>

int main(int, char** arguments) {
  const sublimit::LimitSurface surface(sublimit::read_mesh(arguments[1]), "catmull-clark");
  const sublimit::LimitSamples samples = surface.evaluate(surface.grid(409), 2);
  double largest = 0;
  for (sublimit::Index i = 0; i < samples.position.rows(); ++i)
    if (const auto curvature = sublimit::curvature(samples, i)) largest = std::max(largest, curvature->gauss);
  std::cout << samples.position.rows() << " samples, Gauss curvature up to " << largest << "\n";
}
