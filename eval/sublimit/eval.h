/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SUBLIMIT_EVAL_H
#define SUBLIMIT_EVAL_H
/* Baked tables from C: make or load a table once, apply it every frame, free it.
 *
 * Functions return SUBLIMIT_OK or what went wrong; `sublimit_last_error` says more. Nothing is thrown, and results that
 * a failed call would have made are not to be used. A table never changes: any number of threads may use it at once.
 * Names end in _f for float and _d for double; a table takes numbers of its own precision only. Lengths count numbers,
 * not bytes. */
#include <stddef.h>
#include <stdint.h>

/* A status that nobody looks at is a mistake that the compiler warns of. */
#ifndef SUBLIMIT_NODISCARD
#if (defined(__cplusplus) && __cplusplus >= 201703L) || (defined(__STDC_VERSION__) && __STDC_VERSION__ >= 202311L)
#define SUBLIMIT_NODISCARD [[nodiscard]]
#elif defined(__GNUC__)
#define SUBLIMIT_NODISCARD __attribute__((warn_unused_result))
#else
#define SUBLIMIT_NODISCARD
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum sublimit_status {
  SUBLIMIT_OK = 0,
  SUBLIMIT_INVALID_MESH = 1,
  SUBLIMIT_UNSUPPORTED_TOPOLOGY = 2,
  SUBLIMIT_INVALID_OPTION = 3,
  SUBLIMIT_INVALID_PARAMETER = 4, /* an argument out of its range, a null pointer, an array of the wrong length */
  SUBLIMIT_FORMAT_ERROR = 5,      /* a file that is no table, or a broken one */
  SUBLIMIT_ANALYSIS_ERROR = 6,
  SUBLIMIT_IO_ERROR = 7,       /* a file that cannot be opened or read */
  SUBLIMIT_RESOURCE_ERROR = 8, /* more memory than there is, predicted */
  SUBLIMIT_BAD_ALLOC = 9,      /* the same, met */
  SUBLIMIT_UNKNOWN_ERROR = 10
} sublimit_status;

/* What the last call of this thread that failed had to say; "" if none did. Valid until the next one that fails. */
const char* sublimit_last_error(void);

typedef enum sublimit_precision { SUBLIMIT_FLOAT = 0, SUBLIMIT_DOUBLE = 1 } sublimit_precision;

/* To be combined by |. */
enum {
  SUBLIMIT_REPRODUCIBLE = 1, /* the same bits on machines of any kind, a little slower */
  SUBLIMIT_CHECKSUMS = 2     /* compare the checksums of a file, which reads all of it */
};

typedef struct sublimit_table sublimit_table;

/* Null is fine. */
void sublimit_table_free(sublimit_table* table);

/* ---- Tables from arrays, which are copied. ---- */

/* Rows of a sparse matrix: row i holds entries offsets[i] .. offsets[i + 1] - 1. */
typedef struct sublimit_rows_f {
  int64_t num_rows;
  const int64_t* offsets; /* num_rows + 1, ascending from 0 */
  const int32_t* columns; /* offsets[num_rows]: control points */
  const float* weights;   /* as many, finite */
} sublimit_rows_f;
typedef struct sublimit_rows_d {
  int64_t num_rows;
  const int64_t* offsets;
  const int32_t* columns;
  const double* weights;
} sublimit_rows_d;

/* quantities: 1 positions; 3 derivatives along u and v too; 6 those along uu, uv and vv as well. All rows of positions
 * come first, then all derivatives along u, ... */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_rows_f(int32_t num_control_points, int32_t quantities,
                                                              const sublimit_rows_f* rows, uint32_t flags,
                                                              sublimit_table** table);
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_rows_d(int32_t num_control_points, int32_t quantities,
                                                              const sublimit_rows_d* rows, uint32_t flags,
                                                              sublimit_table** table);

/* A matrix for each quantity, one after the other, each row by row. */
typedef struct sublimit_block {
  int32_t rows, columns;
  int64_t weights; /* where it begins */
} sublimit_block;
/* Patches of one block that make the same rows of it. */
typedef struct sublimit_group {
  int32_t block, num_rows;
  int64_t rows; /* where its rows begin */
  int64_t num_patches;
} sublimit_group;

/* Points of a patch = (chosen rows of its block) * (its control points). Zero what is not there. */
typedef struct sublimit_patterns_f {
  int32_t num_control_points;
  int32_t quantities;
  int64_t num_blocks;
  const sublimit_block* blocks;
  int64_t num_weights;
  const float* weights;
  int64_t num_groups;
  const sublimit_group* groups;
  int64_t num_rows;
  const int32_t* rows; /* numbers of rows within a block */
  int64_t num_columns;
  const int32_t* columns;       /* control points of each patch, group by group */
  const int64_t* patch_points;  /* one for each patch: where its points begin; null: one patch after the other */
  int64_t num_copies;           /* pairs */
  const int32_t* copies;        /* (to, from): positions that are copied at the end */
  const sublimit_rows_f* first; /* null, or a step that makes the points which all else is applied to */
  const sublimit_rows_f*
      rest; /* null, or rows of points of no patch, after all others: see sublimit_table_from_rows_f */
} sublimit_patterns_f;
typedef struct sublimit_patterns_d {
  int32_t num_control_points;
  int32_t quantities;
  int64_t num_blocks;
  const sublimit_block* blocks;
  int64_t num_weights;
  const double* weights;
  int64_t num_groups;
  const sublimit_group* groups;
  int64_t num_rows;
  const int32_t* rows;
  int64_t num_columns;
  const int32_t* columns;
  const int64_t* patch_points;
  int64_t num_copies;
  const int32_t* copies;
  const sublimit_rows_d* first;
  const sublimit_rows_d* rest;
} sublimit_patterns_d;

SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_patterns_f(const sublimit_patterns_f* patterns, uint32_t flags,
                                                                  sublimit_table** table);
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_patterns_d(const sublimit_patterns_d* patterns, uint32_t flags,
                                                                  sublimit_table** table);

/* ---- Tables from files ---- */

/* Maps the file, which must not change as long as the table is there. */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_load(const char* path, uint32_t flags, sublimit_table** table);
/* The same of bytes in memory, which must stay as long as the table. */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_load_memory(const void* bytes, size_t num_bytes, uint32_t flags,
                                                              sublimit_table** table);

/* ---- What a table is; zeros of a null table. ---- */

sublimit_precision sublimit_table_precision(const sublimit_table* table);
int32_t sublimit_table_num_control_points(const sublimit_table* table);
int64_t sublimit_table_num_points(const sublimit_table* table);
int32_t sublimit_table_num_quantities(const sublimit_table* table);
/* Of the connectivity of the cage that it was baked for; 0: not known. */
uint64_t sublimit_table_topology_hash(const sublimit_table* table);
/* 1 if its control points are homogeneous columns (w x, w y, w z, w): see `rational` below. */
int32_t sublimit_table_is_rational(const sublimit_table* table);
/* Name of the scheme, "" if not known; as long as the table is there. */
const char* sublimit_table_scheme(const sublimit_table* table);
/* Hash of a cage, to be compared with a table's: faces as sizes and corners, face by face. Null faces: 0. */
uint64_t sublimit_topology_hash(int32_t num_vertices, const int32_t* sizes, int64_t num_faces, const int32_t* corners,
                                int64_t num_corners);
/* Faces between the points, counter-clockwise: first with null arrays, to learn how many there are, then with arrays
 * for so many. Both calls make all faces: keep them. num_faces, num_corners  in: room in `sizes` and `corners`, if
 * these are not null; out: how many there are */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_faces(const sublimit_table* table, int64_t* num_faces,
                                                        int64_t* num_corners, int32_t* sizes, int32_t* corners);

/* ---- Every frame ---- */

/* New points = table * control points; of rational tables homogeneous columns from columns, nothing is divided.
 * points  num_control_points x channels, interleaved
 * result  quantities x num_points x channels, interleaved: all positions first; must not overlap the points */
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_f(const sublimit_table* table, const float* points,
                                                    size_t num_point_numbers, int32_t channels, float* result,
                                                    size_t num_result_numbers);
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_d(const sublimit_table* table, const double* points,
                                                    size_t num_point_numbers, int32_t channels, double* result,
                                                    size_t num_result_numbers);

/* Channel c of point i of frame f is number  f * frame + i * point + c * channel.  Zeros: as close as can be. */
typedef struct sublimit_layout {
  int64_t point, channel, frame;
} sublimit_layout;

/* Zero what is not wanted. */
typedef struct sublimit_evaluation_f {
  int32_t channels; /* 1 to 64 */
  int32_t frames;   /* 0: one */
  const float* points;
  size_t num_point_numbers; /* all frames, all that lies between */
  sublimit_layout point_layout;
  float* quantities[6];                   /* position, derivatives along u, v, uu, uv, vv */
  float *tangents, *bitangents, *normals; /* unit vectors t, n x t, n; zero where n is not defined */
  size_t num_result_numbers;              /* of each result */
  sublimit_layout result_layout;
  /* 1: the points' last channel is a weight, the others are multiplied by it; results are divided by it and have one
   * channel less, derivatives follow the quotient rule. Where the weight's magnitude is not larger than `least_weight`,
   * results are zero: a pole. */
  int32_t rational;
  float least_weight;
} sublimit_evaluation_f;
typedef struct sublimit_evaluation_d {
  int32_t channels;
  int32_t frames;
  const double* points;
  size_t num_point_numbers;
  sublimit_layout point_layout;
  double* quantities[6];
  double *tangents, *bitangents, *normals;
  size_t num_result_numbers;
  sublimit_layout result_layout;
  int32_t rational;
  double least_weight;
} sublimit_evaluation_d;

SUBLIMIT_NODISCARD sublimit_status sublimit_evaluate_f(const sublimit_table* table,
                                                       const sublimit_evaluation_f* evaluation);
SUBLIMIT_NODISCARD sublimit_status sublimit_evaluate_d(const sublimit_table* table,
                                                       const sublimit_evaluation_d* evaluation);

/* Gradients: result = table^T * values.
 * values  the first, or more, of the quantities x num_points x channels
 * result  num_control_points x channels, overwritten */
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_transpose_f(const sublimit_table* table, const float* values,
                                                              size_t num_value_numbers, int32_t channels, float* result,
                                                              size_t num_result_numbers);
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_transpose_d(const sublimit_table* table, const double* values,
                                                              size_t num_value_numbers, int32_t channels,
                                                              double* result, size_t num_result_numbers);

#ifdef __cplusplus
}
#endif
#endif
