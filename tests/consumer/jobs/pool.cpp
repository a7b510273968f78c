// A table applied by threads of one's own. Needs sublimit::eval alone.
#include <sublimit/eval/table.h>

#include <thread>

int main() {
  const sublimit::Table table = sublimit::load("table.safetensors");
  std::vector<float> points(3 * size_t(table.num_control_points()), 1), result(table.num_results(3));
  const sublimit::TableFrame<float> frame(table, points, 3, result);
  std::vector<std::jthread> pool;
  for (int part = 0; part < 4; ++part) pool.emplace_back([&, part] { frame.apply_part(part, 4); });
  pool.clear();
  return frame.finish(), result.back() == 1 ? 0 : 1;
}
