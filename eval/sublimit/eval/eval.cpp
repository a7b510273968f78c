// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/eval.h"

#include <algorithm>
#include <array>
#include <new>

#include "sublimit/base/error.h"
#include "sublimit/eval/detail/eval_handle.h"

namespace sublimit::c {
namespace {

/// Of this thread. Not a std::string: to keep what went wrong must not fail.
thread_local std::array<char, 1024> last_error{};

sublimit_status keep(sublimit_status status, const char* message) noexcept {
  size_t length = 0;
  for (; message[length] != '\0' && length + 1 < last_error.size(); ++length) last_error[length] = message[length];
  last_error[length] = '\0';
  return status;
}

sublimit_status status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_mesh:
      return SUBLIMIT_INVALID_MESH;
    case ErrorCode::unsupported_topology:
      return SUBLIMIT_UNSUPPORTED_TOPOLOGY;
    case ErrorCode::invalid_option:
      return SUBLIMIT_INVALID_OPTION;
    case ErrorCode::invalid_parameter:
      return SUBLIMIT_INVALID_PARAMETER;
    case ErrorCode::format_error:
      return SUBLIMIT_FORMAT_ERROR;
    case ErrorCode::analysis_error:
      return SUBLIMIT_ANALYSIS_ERROR;
    case ErrorCode::io_error:
      return SUBLIMIT_IO_ERROR;
    case ErrorCode::resource_error:
      return SUBLIMIT_RESOURCE_ERROR;
  }
  return SUBLIMIT_UNKNOWN_ERROR;
}

/// @throws InvalidParameter  a null pointer to more than nothing, a negative length
template <class T>
std::span<T> array(const char* name, T* numbers, std::int64_t count) {
  if (count < 0) throw InvalidParameter(std::string(name) + ": " + std::to_string(count) + " of them");
  if (count > 0) check_pointer(numbers, name);
  return {numbers, size_t(count)};
}

template <class T>
SharedArray<T> copied(const char* name, const T* numbers, std::int64_t count) {
  const std::span<const T> all = array(name, numbers, count);
  return std::vector<T>(all.begin(), all.end());
}

template <class Real, class Rows>
StencilTable<Real> table_of(std::int32_t num_control_points, const Rows& rows) {
  if (rows.num_rows < 0 || rows.num_rows == std::numeric_limits<std::int64_t>::max())
    throw InvalidParameter(std::to_string(rows.num_rows) + " rows");
  SharedArray<std::int64_t> offsets = copied("offsets", rows.offsets, rows.num_rows + 1);
  const std::int64_t entries = offsets.back();
  return StencilTable<Real>(num_control_points, std::move(offsets), copied("columns", rows.columns, entries),
                            copied("weights", rows.weights, entries));
}

template <class Real, class Rows>
sublimit_status from_rows(std::int32_t num_control_points, std::int32_t quantities, const Rows* rows,
                          std::uint32_t flags, sublimit_table** table) {
  return guarded([&] {
    check_pointer(table, "table");
    *table = nullptr;
    check_pointer(rows, "rows");
    check_flags(flags);
    typename PatternTable<Real>::Arrays arrays;
    arrays.quantities = quantities;
    arrays.rest = table_of<Real>(num_control_points, *rows);
    BakedTable<Real> baked;
    baked.table = PatternTable<Real>(num_control_points, std::move(arrays));
    hand_out(std::move(baked), flags, table);
  });
}

template <class Real, class Patterns>
sublimit_status from_patterns(const Patterns* patterns, std::uint32_t flags, sublimit_table** table) {
  return guarded([&] {
    check_pointer(table, "table");
    *table = nullptr;
    check_pointer(patterns, "patterns");
    check_flags(flags);
    const Patterns& p = *patterns;
    typename PatternTable<Real>::Arrays arrays;
    arrays.quantities = p.quantities;
    for (const sublimit_block& block : array("blocks", p.blocks, p.num_blocks))
      arrays.blocks.push_back({block.rows, block.columns, block.weights});
    std::int64_t num_patches = 0;
    for (const sublimit_group& group : array("groups", p.groups, p.num_groups)) {
      arrays.groups.push_back({group.block, group.num_rows, group.rows, group.num_patches});
      // As many patches as the table accepts fit into 64 bits; what does not is refused there.
      if (group.num_patches > 0 && group.num_patches <= std::numeric_limits<std::int64_t>::max() - num_patches)
        num_patches += group.num_patches;
    }
    arrays.weights = copied("weights", p.weights, p.num_weights);
    arrays.rows = copied("rows", p.rows, p.num_rows);
    arrays.columns = copied("columns", p.columns, p.num_columns);
    if (p.num_copies < 0 || p.num_copies > std::numeric_limits<std::int64_t>::max() / 2)
      throw InvalidParameter(std::to_string(p.num_copies) + " copies");
    arrays.copies = copied("copies", p.copies, 2 * p.num_copies);
    std::int32_t num_inputs = p.num_control_points;
    if (p.first) {
      arrays.first = table_of<Real>(p.num_control_points, *p.first);
      num_inputs = static_cast<std::int32_t>(
          std::min<std::int64_t>(arrays.first->num_rows(), std::numeric_limits<std::int32_t>::max()));
    }
    if (p.rest) arrays.rest = table_of<Real>(num_inputs, *p.rest);
    BakedTable<Real> baked;
    if (p.patch_points) {
      // Only when it is known that there are so many patches can their places be read.
      PatternTable<Real>(p.num_control_points, arrays);
      arrays.patch_points = copied("patch_points", p.patch_points, num_patches);
    }
    baked.table = PatternTable<Real>(p.num_control_points, std::move(arrays));
    hand_out(std::move(baked), flags, table);
  });
}

/// @throws InvalidParameter  none, or one of the other precision
template <class Real>
const Handle<Real>& handle_of(const sublimit_table* table) {
  check_pointer(table, "table");
  if (const auto* handle = std::get_if<Handle<Real>>(&table->of)) return *handle;
  throw InvalidParameter(sizeof(Real) == 4 ? "the table is of double; take the function that ends in _d"
                                           : "the table is of float; take the function that ends in _f");
}

template <class Real>
std::span<Real> numbers(const char* name, Real* first, size_t count) {
  if (count > 0) check_pointer(first, name);
  return {first, count};
}

template <class Real>
sublimit_status apply(const sublimit_table* table, const Real* points, size_t num_points, std::int32_t channels,
                      Real* result, size_t num_results) {
  return guarded([&] {
    handle_of<Real>(table).evaluator.apply(numbers("points", points, num_points), channels,
                                           numbers("result", result, num_results));
  });
}

template <class Real>
sublimit_status transpose(const sublimit_table* table, const Real* values, size_t num_values, std::int32_t channels,
                          Real* result, size_t num_results) {
  return guarded([&] {
    handle_of<Real>(table).evaluator.apply_transpose(numbers("values", values, num_values), channels,
                                                     numbers("result", result, num_results));
  });
}

PointLayout layout_of(const sublimit_layout& layout) {
  return {layout.point, layout.channel == 0 ? 1 : layout.channel, layout.frame};
}

template <class Real, class Given>
sublimit_status evaluate(const sublimit_table* table, const Given* given) {
  return guarded([&] {
    const Handle<Real>& handle = handle_of<Real>(table);
    check_pointer(given, "evaluation");
    const Given& g = *given;
    Evaluation<Real> e;
    e.channels = g.channels;
    e.frames = g.frames == 0 ? 1 : g.frames;
    e.points = numbers("points", g.points, g.num_point_numbers);
    e.point_layout = layout_of(g.point_layout);
    // An empty span is not wanted, so one that is wanted and too short to hold anything would pass in silence.
    const auto result = [&](Real* first) {
      if (first && g.num_result_numbers == 0 && handle.evaluator.table().num_points() > 0)
        throw InvalidParameter("results of no numbers");
      return first ? std::span<Real>(first, g.num_result_numbers) : std::span<Real>();
    };
    for (size_t q = 0; q < e.quantities.size(); ++q) e.quantities[q] = result(g.quantities[q]);
    e.tangents = result(g.tangents);
    e.bitangents = result(g.bitangents);
    e.normals = result(g.normals);
    e.result_layout = layout_of(g.result_layout);
    e.rational = g.rational != 0;
    e.least_weight = g.least_weight;
    handle.evaluator.apply(e);
  });
}

/// What `query` says of a table of any precision; zero of none.
template <class Result, class Query>
Result ask(const sublimit_table* table, const Query& query) {
  if (!table) return Result();
  if (const auto* f = std::get_if<Handle<float>>(&table->of)) return query(f->baked);
  if (const auto* d = std::get_if<Handle<double>>(&table->of)) return query(d->baked);
  return Result();
}

}  // namespace

sublimit_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return keep(status_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return keep(SUBLIMIT_BAD_ALLOC, "out of memory");
  } catch (const std::exception& error) {
    return keep(SUBLIMIT_UNKNOWN_ERROR, error.what());
  } catch (...) {
    return keep(SUBLIMIT_UNKNOWN_ERROR, "an unknown error");
  }
}

void check_pointer(const void* pointer, const char* name) {
  if (!pointer) throw InvalidParameter(std::string(name) + " is null");
}

void check_flags(std::uint32_t flags) {
  if ((flags & ~std::uint32_t(SUBLIMIT_REPRODUCIBLE | SUBLIMIT_CHECKSUMS)) != 0)
    throw InvalidParameter("flags " + std::to_string(flags) + " do not exist");
}

}  // namespace sublimit::c

using namespace sublimit;

const char* sublimit_last_error(void) { return c::last_error.data(); }

void sublimit_table_free(sublimit_table* table) { delete table; }

sublimit_status sublimit_table_from_rows_f(int32_t num_control_points, int32_t quantities, const sublimit_rows_f* rows,
                                           uint32_t flags, sublimit_table** table) {
  return c::from_rows<float>(num_control_points, quantities, rows, flags, table);
}
sublimit_status sublimit_table_from_rows_d(int32_t num_control_points, int32_t quantities, const sublimit_rows_d* rows,
                                           uint32_t flags, sublimit_table** table) {
  return c::from_rows<double>(num_control_points, quantities, rows, flags, table);
}
sublimit_status sublimit_table_from_patterns_f(const sublimit_patterns_f* patterns, uint32_t flags,
                                               sublimit_table** table) {
  return c::from_patterns<float>(patterns, flags, table);
}
sublimit_status sublimit_table_from_patterns_d(const sublimit_patterns_d* patterns, uint32_t flags,
                                               sublimit_table** table) {
  return c::from_patterns<double>(patterns, flags, table);
}

sublimit_precision sublimit_table_precision(const sublimit_table* table) {
  return table && std::holds_alternative<c::Handle<double>>(table->of) ? SUBLIMIT_DOUBLE : SUBLIMIT_FLOAT;
}
int32_t sublimit_table_num_control_points(const sublimit_table* table) {
  return c::ask<int32_t>(table, [](const auto& t) { return t.table.num_control_points(); });
}
int64_t sublimit_table_num_points(const sublimit_table* table) {
  return c::ask<int64_t>(table, [](const auto& t) { return t.table.num_points(); });
}
int32_t sublimit_table_num_quantities(const sublimit_table* table) {
  return c::ask<int32_t>(table, [](const auto& t) { return t.table.quantities(); });
}
int32_t sublimit_table_is_rational(const sublimit_table* table) {
  return c::ask<int32_t>(table, [](const auto& t) { return t.info.rational ? 1 : 0; });
}
uint64_t sublimit_table_topology_hash(const sublimit_table* table) {
  return c::ask<uint64_t>(table, [](const auto& t) { return t.info.topology_hash; });
}
const char* sublimit_table_scheme(const sublimit_table* table) {
  const char* const scheme = c::ask<const char*>(table, [](const auto& t) { return t.info.scheme.c_str(); });
  return scheme ? scheme : "";
}

uint64_t sublimit_topology_hash(int32_t num_vertices, const int32_t* sizes, int64_t num_faces, const int32_t* corners,
                                int64_t num_corners) {
  if (num_faces < 0 || num_corners < 0 || (num_faces > 0 && !sizes) || (num_corners > 0 && !corners)) return 0;
  return topology_hash(num_vertices, {sizes, size_t(num_faces)}, {corners, size_t(num_corners)});
}

sublimit_status sublimit_table_faces(const sublimit_table* table, int64_t* num_faces, int64_t* num_corners,
                                     int32_t* sizes, int32_t* corners) {
  return c::guarded([&] {
    c::check_pointer(table, "table");
    c::check_pointer(num_faces, "num_faces");
    c::check_pointer(num_corners, "num_corners");
    const FaceList faces = c::ask<FaceList>(table, [](const auto& t) { return faces_of(t); });
    const auto room = [](const char* name, const int32_t* to, int64_t there, const auto& needed) {
      if (to && there < int64_t(needed.size()))
        throw InvalidParameter(std::string(name) + " has room for " + std::to_string(there) + " numbers; " +
                               std::to_string(needed.size()) + " are needed");
    };
    room("sizes", sizes, *num_faces, faces.sizes);
    room("corners", corners, *num_corners, faces.corners);
    *num_faces = int64_t(faces.sizes.size());
    *num_corners = int64_t(faces.corners.size());
    if (sizes) std::copy(faces.sizes.begin(), faces.sizes.end(), sizes);
    if (corners) std::copy(faces.corners.begin(), faces.corners.end(), corners);
  });
}

sublimit_status sublimit_apply_f(const sublimit_table* table, const float* points, size_t num_point_numbers,
                                 int32_t channels, float* result, size_t num_result_numbers) {
  return c::apply(table, points, num_point_numbers, channels, result, num_result_numbers);
}
sublimit_status sublimit_apply_d(const sublimit_table* table, const double* points, size_t num_point_numbers,
                                 int32_t channels, double* result, size_t num_result_numbers) {
  return c::apply(table, points, num_point_numbers, channels, result, num_result_numbers);
}
sublimit_status sublimit_evaluate_f(const sublimit_table* table, const sublimit_evaluation_f* evaluation) {
  return c::evaluate<float>(table, evaluation);
}
sublimit_status sublimit_evaluate_d(const sublimit_table* table, const sublimit_evaluation_d* evaluation) {
  return c::evaluate<double>(table, evaluation);
}
sublimit_status sublimit_apply_transpose_f(const sublimit_table* table, const float* values, size_t num_value_numbers,
                                           int32_t channels, float* result, size_t num_result_numbers) {
  return c::transpose(table, values, num_value_numbers, channels, result, num_result_numbers);
}
sublimit_status sublimit_apply_transpose_d(const sublimit_table* table, const double* values, size_t num_value_numbers,
                                           int32_t channels, double* result, size_t num_result_numbers) {
  return c::transpose(table, values, num_value_numbers, channels, result, num_result_numbers);
}
