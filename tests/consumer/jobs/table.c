/* The same table, in C. */
#include <stdio.h>
#include <sublimit/eval/eval.h>

int main(void) {
  static float points[3 * 8], result[3 * 4096];
  sublimit_table* table = NULL;
  if (sublimit_table_load("table.safetensors", 0, &table) != SUBLIMIT_OK) return puts(sublimit_last_error()), 1;
  const int64_t numbers = 3 * sublimit_table_num_points(table);
  if (sublimit_apply_f(table, points, 3 * 8, 3, result, (size_t)numbers) != SUBLIMIT_OK)
    return puts(sublimit_last_error()), 1;
  printf("%d numbers\n", (int)numbers);
  sublimit_table_free(table);
}
