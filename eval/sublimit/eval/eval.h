/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SUBLIMIT_EVAL_H
#define SUBLIMIT_EVAL_H
/* Baked tables in C: load or make a table once, apply it every frame, free it:
 *
 *   sublimit_table* table = NULL;
 *   if (sublimit_table_load("level3.safetensors", 0, &table) != SUBLIMIT_OK) return puts(sublimit_last_error());
 *   const size_t num_results = 3 * (size_t)sublimit_table_num_points(table);
 *   float* result = malloc(num_results * sizeof(float));
 *   if (sublimit_apply_f(table, points, num_numbers, 3, result, num_results) != SUBLIMIT_OK) return 1;
 *   sublimit_table_free(table);
 *
 * Functions return SUBLIMIT_OK or the kind of an error, whose message is that of `sublimit_last_error`. No function
 * throws. After an error, results have no defined values. A table never changes: any number of threads may use it at
 * once, and one of them frees it in the end. Names end in _f for float and _d for double; a table takes numbers of its
 * own precision only. Lengths count numbers, not bytes. */
#include <stddef.h>
#include <stdint.h>

/* Makes compilers warn of a status that is ignored. */
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
#ifdef __GNUC__
#pragma GCC visibility push(default) /* a shared library that links this one exports these functions */
#endif

typedef enum sublimit_status {
  SUBLIMIT_OK = 0,
  SUBLIMIT_INVALID_MESH = 1,
  SUBLIMIT_UNSUPPORTED_TOPOLOGY = 2,
  SUBLIMIT_INVALID_OPTION = 3,
  SUBLIMIT_INVALID_PARAMETER = 4, /* an argument outside its range, a null pointer, an array of the wrong length */
  SUBLIMIT_FORMAT_ERROR = 5,      /* a file that is not a table, or a damaged one */
  SUBLIMIT_ANALYSIS_ERROR = 6,
  SUBLIMIT_IO_ERROR = 7,       /* a file that cannot be opened or read */
  SUBLIMIT_RESOURCE_ERROR = 8, /* not enough memory, predicted before it is taken */
  SUBLIMIT_BAD_ALLOC = 9,      /* an allocation failed */
  SUBLIMIT_UNKNOWN_ERROR = 10
} sublimit_status;

/* Returns the message of the last call of this thread that failed, "" if none did. Valid until the next call of this
 * thread that fails; cut to 1023 bytes. */
const char* sublimit_last_error(void);

/* Type of a table's weights, and of the numbers that it takes and makes. */
typedef enum sublimit_precision { SUBLIMIT_FLOAT = 0, SUBLIMIT_DOUBLE = 1 } sublimit_precision;

/* Flags for making and loading tables, combined by |; 0: none. */
enum {
  SUBLIMIT_REPRODUCIBLE = 1, /* results have the same bits on machines of any kind; a little slower */
  SUBLIMIT_CHECKSUMS = 2     /* compare the checksums of a file, which reads all of it; otherwise ignored */
};

/* A table, made and freed by the functions below. */
typedef struct sublimit_table sublimit_table;

/* Frees a table. No thread may be using it. Null is allowed and does nothing. */
void sublimit_table_free(sublimit_table* table);

/* ---- Tables from arrays ----
 * Arrays are copied. `*table` is null after an error. */

/* Rows of a sparse matrix: row i holds entries offsets[i] .. offsets[i + 1] - 1. */
typedef struct sublimit_rows_f {
  int64_t num_rows;
  const int64_t* offsets; /* num_rows + 1, ascending from 0 */
  const int32_t* columns; /* control point of each entry, offsets[num_rows] of them */
  const float* weights;   /* weight of each entry, finite */
} sublimit_rows_f;
typedef struct sublimit_rows_d {
  int64_t num_rows;
  const int64_t* offsets;
  const int32_t* columns;
  const double* weights;
} sublimit_rows_d;

/* Makes a table of rows: all rows of positions first, then those of derivatives along u, then v, uu, uv, vv.
 * num_control_points  points that the table is applied to
 * quantities          1: positions; 3: derivatives along u and v too; 6: those along uu, uv and vv as well */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_rows_f(int32_t num_control_points, int32_t quantities,
                                                              const sublimit_rows_f* rows, uint32_t flags,
                                                              sublimit_table** table);
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_rows_d(int32_t num_control_points, int32_t quantities,
                                                              const sublimit_rows_d* rows, uint32_t flags,
                                                              sublimit_table** table);

/* A block of weights: a rows x columns matrix for each quantity, one after the other, each row by row. */
typedef struct sublimit_block {
  int32_t rows, columns;
  int64_t weights; /* index of its first weight */
} sublimit_block;
/* Patches that use the same rows of one block. */
typedef struct sublimit_group {
  int32_t block, num_rows;
  int64_t rows; /* index of its first row in `rows` below */
  int64_t num_patches;
} sublimit_group;

/* A table by patterns: points of a patch = (selected rows of its block) * (its control points). Set counts and
 * pointers of absent arrays to zero. */
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
  const int32_t* rows; /* rows of a block that each group uses, group by group */
  int64_t num_columns;
  const int32_t* columns;       /* control points of each patch, group by group */
  const int64_t* patch_points;  /* index of the first point of each patch; null: one patch after the other */
  int64_t num_copies;           /* number of pairs in `copies` */
  const int32_t* copies;        /* pairs (to, from): points whose positions are copied at the end */
  const sublimit_rows_f* first; /* null, or a step from control points to the points that patches are applied to */
  const sublimit_rows_f* rest;  /* null, or rows of the points of no patch, which are the last ones */
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

/* Makes a table by patterns. */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_patterns_f(const sublimit_patterns_f* patterns, uint32_t flags,
                                                                  sublimit_table** table);
SUBLIMIT_NODISCARD sublimit_status sublimit_table_from_patterns_d(const sublimit_patterns_d* patterns, uint32_t flags,
                                                                  sublimit_table** table);

/* ---- Tables from files ---- */

/* Maps a file into memory; the file must not change while the table exists. */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_load(const char* path, uint32_t flags, sublimit_table** table);
/* Makes a table of the bytes of a file in memory, which must stay valid and unchanged while the table exists. */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_load_memory(const void* bytes, size_t num_bytes, uint32_t flags,
                                                              sublimit_table** table);

/* ---- Properties of a table ----
 * For a null table all of them are zero, and the scheme is "". */

/* Types and counts: of weights, of the points that it takes, of the points that it makes, of quantities (1, 3, 6). */
sublimit_precision sublimit_table_precision(const sublimit_table* table);
int32_t sublimit_table_num_control_points(const sublimit_table* table);
int64_t sublimit_table_num_points(const sublimit_table* table);
int32_t sublimit_table_num_quantities(const sublimit_table* table);
/* Returns the hash of the connectivity that the table was baked for; 0: not recorded. */
uint64_t sublimit_table_topology_hash(const sublimit_table* table);
/* Returns 1 if control points are homogeneous columns (w x, w y, w z, w), see `rational` below; else 0. */
int32_t sublimit_table_is_rational(const sublimit_table* table);
/* Returns the name of the scheme, "" if it is not recorded. Valid while the table exists. */
const char* sublimit_table_scheme(const sublimit_table* table);
/* Returns the hash of the connectivity of a control mesh, to compare with that of a table.
 * sizes    corners of each face
 * corners  vertices of all faces, face by face; 0 is returned if an array is null */
uint64_t sublimit_topology_hash(int32_t num_vertices, const int32_t* sizes, int64_t num_faces, const int32_t* corners,
                                int64_t num_corners);
/* Writes the faces between the points, counter-clockwise. Call it with null arrays to get their numbers, then with
 * arrays of that size. Each call makes all faces.
 * num_faces, num_corners  in: sizes of the arrays `sizes` and `corners`, if not null; out: numbers of faces, corners */
SUBLIMIT_NODISCARD sublimit_status sublimit_table_faces(const sublimit_table* table, int64_t* num_faces,
                                                        int64_t* num_corners, int32_t* sizes, int32_t* corners);

/* ---- Every frame ---- */

/* New points = table * control points. Of rational tables homogeneous columns from columns, and nothing is divided:
 * `Table::apply` of C++ divides, as `sublimit_evaluate_f` below does if its `rational` is 1.
 * points  num_control_points x channels, interleaved
 * result  quantities x num_points x channels, interleaved: all positions first; must not overlap the points */
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_f(const sublimit_table* table, const float* points,
                                                    size_t num_point_numbers, int32_t channels, float* result,
                                                    size_t num_result_numbers);
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_d(const sublimit_table* table, const double* points,
                                                    size_t num_point_numbers, int32_t channels, double* result,
                                                    size_t num_result_numbers);

/* Strides of an array: channel c of point i of frame f is number  f * frame + i * point + c * channel.  Zeros stand
 * for dense arrays: channel 1, point as many as channels, frame as many as a frame has. */
typedef struct sublimit_layout {
  int64_t point, channel, frame;
} sublimit_layout;

/* One evaluation: points, results and their layouts. Set unwanted results to null. */
typedef struct sublimit_evaluation_f {
  int32_t channels; /* 1 to 64 */
  int32_t frames;   /* sets of points; 0: one */
  const float* points;
  size_t num_point_numbers; /* numbers of the array `points`: all frames, gaps included */
  sublimit_layout point_layout;
  float* quantities[6];                   /* position, derivatives along u, v, uu, uv, vv */
  float *tangents, *bitangents, *normals; /* unit vectors t, n x t, n; zero where n is undefined */
  size_t num_result_numbers;              /* numbers of each result's array */
  sublimit_layout result_layout;
  /* 1: the last channel of the points is their weight, and the other channels are multiplied by it. Results are
   * divided by the weight and have one channel less; derivatives follow the quotient rule. Results are zero where the
   * magnitude of the weight is at most `least_weight`: a pole. */
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

/* Makes the results that an evaluation asks for. */
SUBLIMIT_NODISCARD sublimit_status sublimit_evaluate_f(const sublimit_table* table,
                                                       const sublimit_evaluation_f* evaluation);
SUBLIMIT_NODISCARD sublimit_status sublimit_evaluate_d(const sublimit_table* table,
                                                       const sublimit_evaluation_d* evaluation);

/* Makes gradients with respect to control points: result = table^T * values.
 * values  quantities x num_points x channels, or the first quantities alone
 * result  num_control_points x channels, overwritten */
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_transpose_f(const sublimit_table* table, const float* values,
                                                              size_t num_value_numbers, int32_t channels, float* result,
                                                              size_t num_result_numbers);
SUBLIMIT_NODISCARD sublimit_status sublimit_apply_transpose_d(const sublimit_table* table, const double* values,
                                                              size_t num_value_numbers, int32_t channels,
                                                              double* result, size_t num_result_numbers);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
