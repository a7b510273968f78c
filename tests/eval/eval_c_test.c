/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface as C sees it. Each check returns null, or what is not as it should be. */
#include "sublimit/eval/eval.h"

#include <string.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
#define EXPECT(condition) \
  if (!(condition)) return __FILE__ ":" TEXT(__LINE__) ": " #condition
/* Refused with this status and a message that has these words. */
#define EXPECT_REFUSED(call, status, words) \
  EXPECT((call) == (status));               \
  EXPECT(strstr(sublimit_last_error(), words) != NULL)

const char* check_rows(void);
const char* check_patterns(void);
const char* check_misuse(void);

/* Positions and derivatives of one point: the middle of two. */
static const int64_t offsets[] = {0, 2, 4, 6};
static const int32_t columns[] = {0, 1, 0, 1, 0, 1};
static const float weights_f[] = {0.5f, 0.5f, -1, 1, 1, 1};
static const double weights_d[] = {0.5, 0.5, -1, 1, 1, 1};

const char* check_rows(void) {
  const sublimit_rows_f rows = {3, offsets, columns, weights_f};
  const float points[] = {0, 0, 0, 2, 4, 0}, values[] = {0, 0, 0, 1, 2, 3, 0, 0, 0};
  float made[9], given[6];
  sublimit_table* table = NULL;
  EXPECT(sublimit_table_from_rows_f(2, 3, &rows, SUBLIMIT_REPRODUCIBLE, &table) == SUBLIMIT_OK);
  EXPECT(sublimit_table_precision(table) == SUBLIMIT_FLOAT);
  EXPECT(sublimit_table_num_control_points(table) == 2);
  EXPECT(sublimit_table_num_points(table) == 1);
  EXPECT(sublimit_table_num_quantities(table) == 3);
  EXPECT(sublimit_table_topology_hash(table) == 0);
  EXPECT(strcmp(sublimit_table_scheme(table), "") == 0);
  EXPECT(sublimit_apply_f(table, points, 6, 3, made, 9) == SUBLIMIT_OK);
  EXPECT(made[0] == 1 && made[1] == 2 && made[2] == 0);
  EXPECT(made[3] == 2 && made[4] == 4 && made[6] == 2 && made[7] == 4);
  EXPECT(sublimit_apply_transpose_f(table, values, 9, 3, given, 6) == SUBLIMIT_OK);
  EXPECT(given[0] == -1 && given[1] == -2 && given[2] == -3 && given[3] == 1 && given[4] == 2 && given[5] == 3);
  {
    /* Planar, positions and normals alone. Both derivatives are along one line, which has no normal. */
    const float planar[] = {0, 2, 0, 4, 0, 0};
    float position[3] = {7, 7, 7}, normal[3] = {7, 7, 7};
    sublimit_evaluation_f evaluation;
    memset(&evaluation, 0, sizeof evaluation);
    evaluation.channels = 3;
    evaluation.points = planar;
    evaluation.num_point_numbers = 6;
    evaluation.point_layout.point = 1;
    evaluation.point_layout.channel = 2;
    evaluation.quantities[0] = position;
    evaluation.normals = normal;
    evaluation.num_result_numbers = 3;
    EXPECT(sublimit_evaluate_f(table, &evaluation) == SUBLIMIT_OK);
    EXPECT(position[0] == 1 && position[1] == 2 && position[2] == 0);
    EXPECT(normal[0] == 0 && normal[1] == 0 && normal[2] == 0);
  }
  sublimit_table_free(table);
  return NULL;
}

const char* check_patterns(void) {
  /* Means of two points, and copies of one: three patches in two groups, the second one's points first. */
  const sublimit_block blocks[] = {{2, 2, 0}, {1, 1, 4}};
  const double block_weights[] = {0.5, 0.5, 0.25, 0.75, 1};
  const sublimit_group groups[] = {{0, 2, 0, 2}, {1, 1, 2, 1}};
  const int32_t chosen[] = {1, 0, 0}, of_patches[] = {0, 1, 1, 2, 2}, copies[] = {0, 4};
  const int64_t places[] = {1, 3, 0};
  const double points[] = {0, 4, 12};
  double made[5];
  int64_t faces = -1, corners = -1;
  sublimit_patterns_d patterns;
  sublimit_table* table = NULL;
  memset(&patterns, 0, sizeof patterns);
  patterns.num_control_points = 3;
  patterns.quantities = 1;
  patterns.num_blocks = 2, patterns.blocks = blocks;
  patterns.num_weights = 5, patterns.weights = block_weights;
  patterns.num_groups = 2, patterns.groups = groups;
  patterns.num_rows = 3, patterns.rows = chosen;
  patterns.num_columns = 5, patterns.columns = of_patches;
  EXPECT(sublimit_table_from_patterns_d(&patterns, 0, &table) == SUBLIMIT_OK);
  EXPECT(sublimit_table_precision(table) == SUBLIMIT_DOUBLE);
  EXPECT(sublimit_apply_d(table, points, 3, 1, made, 5) == SUBLIMIT_OK);
  EXPECT(made[0] == 3 && made[1] == 2 && made[2] == 10 && made[3] == 8 && made[4] == 12);
  EXPECT(sublimit_table_faces(table, &faces, &corners, NULL, NULL) == SUBLIMIT_OK);
  EXPECT(faces == 0 && corners == 0);
  sublimit_table_free(table);

  patterns.patch_points = places;
  patterns.num_copies = 1, patterns.copies = copies;
  EXPECT(sublimit_table_from_patterns_d(&patterns, 0, &table) == SUBLIMIT_OK);
  EXPECT(sublimit_apply_d(table, points, 3, 1, made, 5) == SUBLIMIT_OK);
  EXPECT(made[0] == 8 && made[1] == 3 && made[2] == 2 && made[3] == 10 && made[4] == 8);
  sublimit_table_free(table);

  {
    /* By way of 0, 4, 8; and a point of no patch. */
    const int64_t first_offsets[] = {0, 1, 3, 4}, rest_offsets[] = {0, 2};
    const int32_t first_columns[] = {0, 0, 1, 1}, rest_columns[] = {0, 2};
    const double first_weights[] = {1, 0.5, 0.5, 1}, rest_weights[] = {1, 1}, two[] = {0, 8};
    const sublimit_rows_d first = {3, first_offsets, first_columns, first_weights},
                          rest = {1, rest_offsets, rest_columns, rest_weights};
    double six[6];
    patterns.num_control_points = 2;
    patterns.patch_points = NULL;
    patterns.num_copies = 0;
    patterns.first = &first;
    patterns.rest = &rest;
    EXPECT(sublimit_table_from_patterns_d(&patterns, 0, &table) == SUBLIMIT_OK);
    EXPECT(sublimit_apply_d(table, two, 2, 1, six, 6) == SUBLIMIT_OK);
    EXPECT(six[0] == 3 && six[1] == 2 && six[2] == 7 && six[3] == 6 && six[4] == 8 && six[5] == 8);
    sublimit_table_free(table);
  }
  return NULL;
}

const char* check_misuse(void) {
  const sublimit_rows_f rows = {3, offsets, columns, weights_f};
  const sublimit_rows_d rows_d = {3, offsets, columns, weights_d};
  const sublimit_rows_f no_offsets = {3, NULL, columns, weights_f}, no_columns = {3, offsets, NULL, weights_f},
                        negative = {-1, offsets, columns, weights_f};
  const float points[6] = {0};
  const double points_d[6] = {0};
  float made[9];
  double made_d[9];
  int64_t faces = 0, corners = 0;
  const sublimit_status refused = SUBLIMIT_INVALID_PARAMETER;
  sublimit_table *table = NULL, *none = (sublimit_table*)made;
  sublimit_patterns_f patterns;
  sublimit_evaluation_f evaluation;

  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, &rows, 0, NULL), refused, "table is null");
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, NULL, 0, &none), refused, "rows is null");
  EXPECT(none == NULL);
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, &no_offsets, 0, &none), refused, "offsets is null");
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, &no_columns, 0, &none), refused, "columns is null");
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, &negative, 0, &none), refused, "-1 rows");
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 2, &rows, 0, &none), refused, "2 quantities");
  EXPECT_REFUSED(sublimit_table_from_rows_f(1, 3, &rows, 0, &none), refused, "control point 1 of 1");
  EXPECT_REFUSED(sublimit_table_from_rows_f(2, 3, &rows, 8, &none), refused, "flags 8");
  memset(&patterns, 0, sizeof patterns);
  EXPECT_REFUSED(sublimit_table_from_patterns_f(&patterns, 0, &none), refused, "0 quantities");
  patterns.quantities = 1;
  patterns.num_blocks = 1;
  EXPECT_REFUSED(sublimit_table_from_patterns_f(&patterns, 0, &none), refused, "blocks is null");
  patterns.num_blocks = -1;
  EXPECT_REFUSED(sublimit_table_from_patterns_f(&patterns, 0, &none), refused, "blocks: -1");
  EXPECT_REFUSED(sublimit_table_from_patterns_f(NULL, 0, &none), refused, "patterns is null");
  EXPECT_REFUSED(sublimit_table_from_patterns_d(NULL, 0, &none), refused, "patterns is null");

  EXPECT_REFUSED(sublimit_apply_f(NULL, points, 6, 3, made, 9), refused, "table is null");
  EXPECT(sublimit_table_from_rows_f(2, 3, &rows, 0, &table) == SUBLIMIT_OK);
  EXPECT_REFUSED(sublimit_apply_f(table, NULL, 6, 3, made, 9), refused, "points is null");
  EXPECT_REFUSED(sublimit_apply_f(table, points, 6, 3, NULL, 9), refused, "result is null");
  EXPECT_REFUSED(sublimit_apply_f(table, points, 5, 3, made, 9), refused, "points holds 5 numbers");
  EXPECT_REFUSED(sublimit_apply_f(table, points, 6, 3, made, 8), refused, "result holds 8 numbers");
  EXPECT_REFUSED(sublimit_apply_f(table, points, 6, 0, made, 9), refused, "0 channels");
  EXPECT_REFUSED(sublimit_apply_d(table, points_d, 6, 3, made_d, 9), refused, "ends in _f");
  EXPECT_REFUSED(sublimit_apply_transpose_f(table, points, 6, 3, made, 9), refused, "result holds 9 numbers");
  EXPECT_REFUSED(sublimit_apply_transpose_f(table, points, 4, 3, made, 6), refused, "values hold 4 numbers");
  EXPECT_REFUSED(sublimit_evaluate_f(table, NULL), refused, "evaluation is null");
  memset(&evaluation, 0, sizeof evaluation);
  EXPECT_REFUSED(sublimit_evaluate_f(table, &evaluation), refused, "0 channels");
  evaluation.channels = 3;
  EXPECT_REFUSED(sublimit_evaluate_f(table, &evaluation), refused, "points hold 0 numbers");
  evaluation.points = points;
  evaluation.num_point_numbers = 6;
  evaluation.quantities[0] = made;
  EXPECT_REFUSED(sublimit_evaluate_f(table, &evaluation), refused, "no numbers");
  evaluation.num_result_numbers = 2;
  EXPECT_REFUSED(sublimit_evaluate_f(table, &evaluation), refused, "positions hold 2 numbers");
  evaluation.num_result_numbers = 3;
  evaluation.quantities[3] = made + 3;
  EXPECT_REFUSED(sublimit_evaluate_f(table, &evaluation), refused, "3 quantities");
  evaluation.quantities[3] = NULL;
  evaluation.result_layout.point = 1;
  EXPECT(sublimit_evaluate_f(table, &evaluation) == SUBLIMIT_OK); /* one point has no next one */
  EXPECT_REFUSED(sublimit_table_faces(table, NULL, &corners, NULL, NULL), refused, "num_faces is null");
  EXPECT_REFUSED(sublimit_table_faces(NULL, &faces, &corners, NULL, NULL), refused, "table is null");
  sublimit_table_free(table);

  EXPECT(sublimit_table_from_rows_d(2, 3, &rows_d, 0, &table) == SUBLIMIT_OK);
  EXPECT_REFUSED(sublimit_apply_f(table, points, 6, 3, made, 9), refused, "ends in _d");
  sublimit_table_free(table);

  sublimit_table_free(NULL);
  EXPECT(sublimit_table_num_points(NULL) == 0 && sublimit_table_num_control_points(NULL) == 0);
  EXPECT(sublimit_table_num_quantities(NULL) == 0 && sublimit_table_topology_hash(NULL) == 0);
  EXPECT(strcmp(sublimit_table_scheme(NULL), "") == 0);
  EXPECT(sublimit_topology_hash(4, NULL, 1, columns, 4) == 0);
  return NULL;
}
