#include <sublimit/base/error.h>
#include <sublimit/eval/table/stencil_table.h>

#include <vector>

extern "C" int use_from_c(void);

int main() {
  if (use_from_c() != 0) return 1;
  // One row: the midpoint of two control points.
  const sublimit::StencilTable<float> table(2, {0, 2}, {0, 1}, {0.5f, 0.5f});
  const std::vector<float> points{0, 0, 0, 2, 4, 6};
  std::vector<float> result(3);
  table.apply(points, 3, result);
  if (result != std::vector<float>{1, 2, 3}) return 1;
  try {
    table.apply(points, 2, result);
  } catch (const sublimit::InvalidParameter&) {
    return 0;
  }
  return 1;
}
