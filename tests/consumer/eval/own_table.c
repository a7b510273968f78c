#include <string.h>
#include <sublimit/eval/eval.h>

int use_from_c(void);

/* The midpoint of two control points, of two frames at once. */
int use_from_c(void) {
  const int64_t offsets[] = {0, 2};
  const int32_t columns[] = {0, 1};
  const float weights[] = {0.5f, 0.5f};
  const sublimit_rows_f rows = {1, offsets, columns, weights};
  const float points[] = {0, 0, 0, 2, 4, 6, 1, 1, 1, 3, 5, 7};
  float positions[6];
  sublimit_evaluation_f evaluation;
  sublimit_table* table = NULL;
  if (sublimit_table_from_rows_f(2, 1, &rows, 0, &table) != SUBLIMIT_OK) return 1;
  memset(&evaluation, 0, sizeof evaluation);
  evaluation.channels = 3;
  evaluation.frames = 2;
  evaluation.points = points;
  evaluation.num_point_numbers = 12;
  evaluation.quantities[0] = positions;
  evaluation.num_result_numbers = 6;
  if (sublimit_evaluate_f(table, &evaluation) != SUBLIMIT_OK) return 1;
  if (positions[0] != 1 || positions[2] != 3 || positions[3] != 2 || positions[5] != 4) return 1;
  evaluation.num_point_numbers = 11;
  if (sublimit_evaluate_f(table, &evaluation) != SUBLIMIT_INVALID_PARAMETER) return 1;
  if (strstr(sublimit_last_error(), "points hold 11 numbers; 12 are needed") == NULL) return 1;
  sublimit_table_free(table);
  return 0;
}
