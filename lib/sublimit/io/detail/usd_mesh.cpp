// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/io/detail/usd.h"
#include "sublimit/io/detail/usd_text.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/mesh/detail/edge_lookup.h"

namespace sublimit {
namespace {

using Found = UsdPrim::Found;
using Matrix = Eigen::Matrix4d;

/// The value of a property at the first time, as text; empty if there is none.
std::string_view first_value(const Found& found, std::string_view what) {
  if (!found) return {};
  if (found.property->part.empty()) return found.property->value;
  const auto samples = usd_samples(*found.layer, found.property->value, what);
  return samples.empty() ? std::string_view() : samples.front().second;
}

std::vector<double> numbers_of(const UsdPrim& prim, std::string_view name, int width) {
  const Found found = prim.find(name);
  const std::string_view value = first_value(found, name);
  return value.empty() ? std::vector<double>() : usd_numbers(*found.layer, value, name, width);
}

/// Two samples and how far a time is from the first one to the second one, 0 to 1.
struct Between {
  std::size_t first, second;
  double part;
};
Between samples_around(const std::vector<double>& times, double time) {
  const auto next = static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
  if (next == times.size()) return {next - 1, next - 1, 0};
  if (next == 0 || times[next] == time) return {next, next, 0};
  return {next - 1, next, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

/// Numbers between those of two samples; those of the first one if they are not as many.
std::vector<double> blended(std::vector<double> first, const std::vector<double>& second, double part) {
  if (first.size() == second.size())
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = std::lerp(first[i], second[i], part);
  return first;
}

/// The numbers of an attribute at a time; if none is given, at the first one.
/// @param times  gets the times of its samples
std::vector<double> numbers_at(const UsdPrim& prim, std::string_view name, int width, std::optional<double> time,
                               std::vector<double>& times) {
  const Found found = prim.find(name);
  if (!found || found.property->part.empty()) return numbers_of(prim, name, width);
  const auto samples = usd_samples(*found.layer, found.property->value, name);
  if (samples.empty()) return {};
  std::vector<double> own;
  for (const auto& [at, value] : samples) own.push_back(at);
  times.insert(times.end(), own.begin(), own.end());
  const auto numbers = [&](std::size_t i) { return usd_numbers(*found.layer, samples[i].second, name, width); };
  if (!time) return numbers(0);
  const Between between = samples_around(own, *time);
  if (between.part == 0) return numbers(between.first);
  return blended(numbers(between.first), numbers(between.second), between.part);
}

std::vector<Index> indices_of(const UsdPrim& prim, std::string_view name, Index least, Index most) {
  const Found found = prim.find(name);
  const std::string_view value = first_value(found, name);
  return value.empty() ? std::vector<Index>() : usd_indices(*found.layer, value, name, least, most);
}

[[noreturn]] void refuse(const UsdPrim& prim, std::string_view name, const std::string& what) {
  const Found found = prim.find(name);
  throw InvalidMesh((found ? found.layer->place(found.property->text) + prim.path + ": " : prim.place()) +
                    std::string(name) + " " + what);
}

/// The last `xformOp` of a transform, after others have been taken off its suffix.
Matrix transform_of(const UsdPrim& prim, const std::string& op, std::optional<double> time,
                    std::vector<double>& times) {
  const std::string kind = op.substr(8, op.find(':', 8) - 8);  // behind "xformOp:"
  Matrix m = Matrix::Identity();
  const auto take = [&](int width) {
    std::vector<double> numbers = numbers_at(prim, op, width, time, times);
    if (numbers.size() != std::size_t(width))
      refuse(prim, op, "should have " + format_number(width) + " numbers; it has " + format_number(numbers.size()));
    return numbers;
  };
  const auto turn = [](int axis, double degrees) {
    Matrix r = Matrix::Identity();
    const double angle = degrees * std::numbers::pi / 180;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    // Quarter turns are exact.
    const double quarters = degrees / 90;
    double c = std::cos(angle), s = std::sin(angle);
    if (quarters == std::floor(quarters) && std::abs(quarters) < 1e9) {
      constexpr std::array cosines{1.0, 0.0, -1.0, 0.0}, sines{0.0, 1.0, 0.0, -1.0};
      const auto at = static_cast<std::size_t>(((static_cast<std::int64_t>(quarters) % 4) + 4) % 4);
      c = cosines[at], s = sines[at];
    }
    r(i, i) = r(j, j) = c;
    r(i, j) = -s, r(j, i) = s;
    return r;
  };
  if (kind == "translate") {
    const auto t = take(3);
    for (int i = 0; i < 3; ++i) m(i, 3) = t[std::size_t(i)];
  } else if (kind == "scale") {
    const auto s = take(3);
    for (int i = 0; i < 3; ++i) m(i, i) = s[std::size_t(i)];
  } else if (kind == "rotateX" || kind == "rotateY" || kind == "rotateZ") {
    m = turn(kind.back() - 'X', take(1)[0]);
  } else if (kind.size() == 9 && kind.starts_with("rotate")) {
    // The first axis of the name is the first to be turned about.
    const auto angles = take(3);
    for (std::size_t k = 6; k < 9; ++k) {
      const int axis = kind[k] - 'X';
      if (axis < 0 || axis > 2) refuse(prim, op, "is no transform that USD knows");
      m = turn(axis, angles[std::size_t(axis)]) * m;
    }
  } else if (kind == "orient") {
    const auto q = take(4);
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (norm > 0) {
      const double w = q[0] / norm, x = q[1] / norm, y = q[2] / norm, z = q[3] / norm;
      m.topLeftCorner<3, 3>() << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
          1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
          1 - 2 * (x * x + y * y);
    }
  } else if (kind == "transform") {
    const auto t = take(16);
    for (int i = 0; i < 16; ++i) m(i % 4, i / 4) = t[std::size_t(i)];  // rows of the file are for row vectors
  } else {
    refuse(prim, op, "is no transform that is read");
  }
  if (!m.allFinite()) refuse(prim, op, "has a number that is not finite");
  return m;
}

/// The transform of a prim in the space of its parent.
/// @param times   gets the times of its samples
/// @param resets  set if the parent's transforms do not hold for it
Matrix local_transform(const UsdPrim& prim, std::optional<double> time, std::vector<double>& times, bool& resets) {
  Matrix m = Matrix::Identity();
  const Found order = prim.find("xformOpOrder");
  if (!order) return m;
  for (std::string op : usd_texts(*order.layer, order.property->value, "xformOpOrder")) {
    if (op == "!resetXformStack!") {
      resets = true;
      m = Matrix::Identity();
      continue;
    }
    const bool inverse = op.starts_with("!invert!");
    if (inverse) op.erase(0, 8);
    if (!op.starts_with("xformOp:")) refuse(prim, "xformOpOrder", "names " + in_quotes(op) + ", which is no transform");
    Matrix next = transform_of(prim, op, time, times);
    if (inverse) next = next.inverse().eval();
    m = m * next;
  }
  if (!m.allFinite()) refuse(prim, "xformOpOrder", "has a transform without an inverse");
  return m;
}

/// The number of a word; absent if nothing is said.
template <class T>
std::optional<T> choice(const UsdPrim& prim, std::string_view name, std::span<const std::string_view> words) {
  const std::string word = prim.text(name);
  if (word.empty()) return std::nullopt;
  const auto found = std::ranges::find(words, word);
  if (found != words.end()) return static_cast<T>(found - words.begin());
  std::string all;
  for (const std::string_view known : words) all += (all.empty() ? "" : ", ") + std::string(known);
  refuse(prim, name, "is " + in_quotes(word) + "; there are " + all);
}

void read_rules(const UsdPrim& prim, Mesh& mesh) {
  constexpr std::array<std::string_view, 4> schemes{"catmullClark", "loop", "bilinear", "none"};
  constexpr std::array names{"catmull-clark", "loop", "bilinear", ""};
  mesh.scheme = names[choice<std::size_t>(prim, "subdivisionScheme", schemes).value_or(0)];
  mesh.boundary = choice<Boundary>(prim, "interpolateBoundary", usd_boundary_words);
  mesh.triangles = choice<Triangles>(prim, "triangleSubdivisionRule", usd_triangles_words);
  mesh.creasing = choice<Creasing>(prim, "sublimit:creaseMethod", usd_creasing_words);
  mesh.face_varying_interpolation =
      choice<FaceVaryingInterpolation>(prim, "faceVaryingLinearInterpolation", usd_face_varying_words);
  // What USD takes where nothing is said differs from `Mesh`.
  if (!mesh.scheme.empty() && !mesh.face_varying_interpolation)
    mesh.face_varying_interpolation = FaceVaryingInterpolation::corners_plus1;
}

std::vector<float> sharpnesses(const UsdPrim& prim, std::string_view name) {
  std::vector<float> values;
  for (const double value : numbers_of(prim, name, 1)) {
    if (!(value >= 0)) refuse(prim, name, "has " + format_number(value) + "; a sharpness should be 0 or more");
    values.push_back(value < double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                       : std::numeric_limits<float>::infinity());
  }
  return values;
}

void read_creases(const UsdPrim& prim, Mesh& mesh) {
  const std::vector<Index> ids = indices_of(prim, "creaseIndices", 0, mesh.num_vertices() - 1);
  const std::vector<Index> lengths = indices_of(prim, "creaseLengths", 2, std::numeric_limits<Index>::max());
  const std::vector<float> sharp = sharpnesses(prim, "creaseSharpnesses");
  std::size_t used = 0;
  for (const Index length : lengths) used += static_cast<std::size_t>(length);
  if (used != ids.size())
    refuse(prim, "creaseLengths",
           "add up to " + format_number(used) + "; creaseIndices has " + format_number(ids.size()) + " vertices");
  const std::size_t edges = used - lengths.size();
  const bool per_chain = sharp.size() == lengths.size();
  if (!per_chain && sharp.size() != edges)
    refuse(prim, "creaseSharpnesses",
           "has " + format_number(sharp.size()) + " values; it should have " + format_number(lengths.size()) +
               ", one for each chain, or " + format_number(edges) + ", one for each edge");
  std::size_t at = 0;
  for (std::size_t chain = 0; chain < lengths.size(); ++chain, ++at)
    for (Index left = lengths[chain]; left > 1; --left, ++at)
      mesh.creases.push_back({ids[at], ids[at + 1], sharp[per_chain ? chain : mesh.creases.size()]});
}

void read_tags(const UsdPrim& prim, Mesh& mesh) {
  read_creases(prim, mesh);
  const std::string place = prim.place();
  drop_loose_creases(mesh, [&](std::size_t) { return place + "creaseIndices: "; });
  const std::vector<Index> ids = indices_of(prim, "cornerIndices", 0, mesh.num_vertices() - 1);
  const std::vector<float> sharp = sharpnesses(prim, "cornerSharpnesses");
  if (sharp.size() != ids.size())
    refuse(prim, "cornerSharpnesses",
           "has " + format_number(sharp.size()) + " values; it should have " + format_number(ids.size()) +
               ", one for each of cornerIndices");
  for (std::size_t i = 0; i < ids.size(); ++i) mesh.corners.push_back({ids[i], sharp[i]});
  mesh.holes = indices_of(prim, "holeIndices", 0, mesh.num_faces() - 1);
  const std::vector<Index> ends = indices_of(prim, "sublimit:knotIntervalEdges", 0, mesh.num_vertices() - 1);
  const std::vector<double> lengths = numbers_of(prim, "sublimit:knotIntervals", 1);
  if (ends.size() != 2 * lengths.size())
    refuse(prim, "sublimit:knotIntervals",
           "has " + format_number(lengths.size()) + " values for " + format_number(ends.size()) +
               " vertices; each is of an edge of two");
  for (std::size_t i = 0; i < lengths.size(); ++i)
    mesh.knot_intervals.push_back({ends[2 * i], ends[2 * i + 1], lengths[i]});
  const std::vector<bool> found = along_edges(mesh, edges_of(mesh.knot_intervals));
  if (std::ranges::find(found, false) != found.end())
    refuse(prim, "sublimit:knotIntervalEdges", "has two vertices between which no face has an edge");
}

Points rows_of(const std::vector<double>& numbers, int width) {
  Points rows(std::ssize(numbers) / width, width);
  std::copy(numbers.begin(), numbers.end(), rows.data());
  return rows;
}

Points points_of(const UsdLayer& layer, std::string_view text, const std::string& place) {
  Points points = rows_of(usd_numbers(layer, text, "points", 3), 3);
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    if (!points.row(v).allFinite())
      throw InvalidMesh(layer.place(text) + "points: point " + format_number(v) +
                        " has a coordinate that is not a finite number");
  checked_index(points.rows(), place, "points");
  return points;
}

/// The corner of the file for each corner, where faces are turned: the first one stays the first.
std::vector<Index> turned_corners(const std::vector<Index>& sizes, std::size_t corners) {
  std::vector<Index> from(corners);
  Index first = 0;
  for (const Index size : sizes) {
    from[std::size_t(first)] = first;
    for (Index k = 1; k < size; ++k) from[std::size_t(first + k)] = first + size - k;
    first += size;
  }
  return from;
}

template <class T>
std::vector<T> taken(const std::vector<T>& values, const std::vector<Index>& from) {
  std::vector<T> out;
  out.reserve(from.size());
  for (const Index i : from) out.push_back(values[std::size_t(i)]);
  return out;
}

void read_faces(const UsdPrim& prim, UsdMesh& out) {
  Mesh& mesh = out.mesh;
  const Index most = std::numeric_limits<Index>::max();
  mesh.face_sizes = indices_of(prim, "faceVertexCounts", 0, most);
  mesh.face_vertices = indices_of(prim, "faceVertexIndices", 0, mesh.num_vertices() - 1);
  std::int64_t corners = 0;
  for (std::size_t f = 0; f < mesh.face_sizes.size(); ++f) {
    if (mesh.face_sizes[f] < 3)
      refuse(prim, "faceVertexCounts",
             "has " + format_number(mesh.face_sizes[f]) + " for face " + format_number(f) +
                 "; a face should have 3 corners or more");
    corners += mesh.face_sizes[f];
  }
  if (corners != std::ssize(mesh.face_vertices))
    refuse(prim, "faceVertexCounts",
           "add up to " + format_number(corners) + "; faceVertexIndices has " +
               format_number(mesh.face_vertices.size()) + " vertices");
  for (const char* const name : {"faceVertexCounts", "faceVertexIndices"})
    if (const Found found = prim.find(name);
        found && !found.property->part.empty() && usd_samples(*found.layer, found.property->value, name).size() > 1)
      mesh.warnings.push_back(found.layer->place(found.property->text) + prim.path + ": " + name +
                              " change in time; those of the first time are taken");
}

/// How many elements an interpolation has in a mesh.
Index elements_of(UsdPrimvar::Interpolation interpolation, const Mesh& mesh) {
  using enum UsdPrimvar::Interpolation;
  if (interpolation == constant) return 1;
  if (interpolation == uniform) return mesh.num_faces();
  return interpolation == face_varying ? static_cast<Index>(mesh.face_vertices.size()) : mesh.num_vertices();
}

void read_primvar(const UsdPrim& prim, const Found& found, UsdMesh& out) {
  using enum UsdPrimvar::Interpolation;
  Mesh& mesh = out.mesh;
  UsdPrimvar primvar;
  primvar.name = std::string(found.property->name.substr(found.property->name.find(':') + 1));
  const std::string where =
      found.layer->place(found.property->text) + prim.path + ": " + std::string(found.property->name);
  const auto leave_out = [&](const std::string& why) { mesh.warnings.push_back(where + " is left out: " + why); };
  const auto type = usd_type(found.property->type);
  const auto note = [&](const std::string& why) { mesh.notes.push_back(where + " is left out: " + why); };
  if (!type) return note("values of type " + std::string(found.property->type) + " are not refined");
  primvar.type = *type;
  int per_element = 1;
  for (const UsdPrim::Opinion& opinion : prim.opinions)
    for (const char* const part : {"", "timeSamples"}) {
      const UsdProperty* const property = opinion.spec->property(found.property->name, part);
      if (!property) continue;
      for (const UsdField& field : property->metadata) {
        if (field.key == "elementSize" && per_element == 1)
          per_element = usd_indices(*opinion.layer, field.value, "elementSize", 1, 1 << 20)[0];
        if (field.key != "interpolation" || primvar.interpolation != constant) continue;
        const auto word = usd_texts(*opinion.layer, field.value, "interpolation");
        constexpr auto& words = usd_interpolation_words;
        const auto known = word.empty() ? words.end() : std::ranges::find(words, word[0]);
        if (known == words.end())
          return leave_out(
              "its interpolation is none of constant, uniform, varying, vertex, "
              "faceVarying");
        primvar.interpolation = UsdPrimvar::Interpolation(known - words.begin());
      }
    }
  if (per_element != 1) return note("it has " + format_number(per_element) + " values for each element");
  const std::string_view value = first_value(found, found.property->name);
  std::vector<double> numbers = usd_numbers(*found.layer, value, found.property->name, type->width);
  for (const double number : numbers)
    if (!std::isfinite(number)) return leave_out("a number of it is not finite");
  primvar.values = rows_of(numbers, type->width);
  const Index count = elements_of(primvar.interpolation, mesh),
              values = checked_index(primvar.values.rows(), where, "values");
  const std::string indices = std::string(found.property->name) + ":indices";
  if (prim.find(indices)) {
    primvar.indices = indices_of(prim, indices, 0, values - 1);
  } else {
    primvar.indices.resize(std::size_t(values));
    std::iota(primvar.indices.begin(), primvar.indices.end(), 0);
  }
  if (primvar.interpolation == constant && std::ssize(primvar.indices) > 1) return note("a list that is constant");
  if (std::ssize(primvar.indices) != count)
    return leave_out("it has " + format_number(primvar.indices.size()) + " values; as " +
                     std::string(usd_interpolation_words[std::size_t(primvar.interpolation)]) + " it should have " +
                     format_number(count));
  out.primvars.push_back(std::move(primvar));
}

void read_primvars(const UsdPrim& prim, UsdMesh& out) {
  constexpr std::string_view prefix = "primvars:", of_indices = ":indices";
  std::vector<std::string_view> names;
  std::unordered_set<std::string_view> known;
  for (const UsdPrim::Opinion& opinion : prim.opinions)
    for (const UsdProperty& property : opinion.spec->properties) {
      const std::string_view name = property.name;
      if (!name.starts_with(prefix) || name.ends_with(of_indices) || name == "primvars:normals") continue;
      if (known.insert(name).second) names.push_back(name);
    }
  for (const std::string_view name : names) {
    const Found found = prim.find(name);
    if (!found) continue;
    const std::size_t before = out.primvars.size();
    read_primvar(prim, found, out);
    if (out.primvars.size() == before) out.left_out.emplace_back(name.substr(prefix.size()));
  }
}

class MeshFinder {
 public:
  MeshFinder(UsdStage& stage, std::vector<std::string>& warnings, std::optional<double> time)
      : stage_(stage), warnings_(warnings), time_(time) {}

  std::vector<UsdMesh> find() {
    stage_.visit([&](const UsdPrim& prim) { return enter(prim); });
    warnings_.insert(warnings_.end(), stage_.unread().begin(), stage_.unread().end());
    return std::move(meshes_);
  }

 private:
  /// What holds for a prim and those below it.
  struct State {
    Matrix to_world = Matrix::Identity();
    std::string shown, material;
    std::vector<double> times = {};  // of samples of transforms
    int mesh = -1;                   // the number of the mesh that it is
  };

  bool enter(const UsdPrim& prim) {
    const State* const above = prim.parent && !prim.parent->path.empty() ? &states_.at(prim.parent->path) : nullptr;
    State state = above ? State{above->to_world, above->shown, above->material, above->times, -1} : State();
    state.shown += (state.shown.empty() ? "" : "/") + prim.shown_name();
    const std::string_view type = prim.type();
    if (const std::string visibility = prim.text("visibility"); visibility == "invisible")
      return hide(prim, visibility);
    if (const std::string purpose = prim.text("purpose"); purpose == "guide" || purpose == "proxy")
      return hide(prim, "a " + purpose);
    bool resets = false;
    const Matrix local = local_transform(prim, time_, state.times, resets);
    state.to_world = resets ? local : (state.to_world * local).eval();
    if (const auto materials = prim.targets("material:binding"); !materials.empty()) state.material = materials.front();
    if (type == "Mesh")
      add_mesh(prim, state);
    else if (type == "GeomSubset" && above && above->mesh >= 0)
      add_subset(prim, meshes_[std::size_t(above->mesh)]);
    else if (type == "PointInstancer")
      return tell(prim, "a PointInstancer is not read; its copies are missing"), false;
    else if (type == "NurbsPatch" || type == "BasisCurves" || type == "NurbsCurves" || type == "Points" ||
             type == "TetMesh" || type == "Sphere" || type == "Cube" || type == "Cylinder" || type == "Cone" ||
             type == "Capsule" || type == "Plane")
      tell(prim, "of type " + std::string(type) + ", of which no mesh is made");
    states_[prim.path] = std::move(state);
    return true;
  }

  void tell(const UsdPrim& prim, const std::string& what) {
    constexpr std::size_t most = 20;
    if (warnings_.size() < most) warnings_.push_back(prim.place() + what);
  }
  bool hide(const UsdPrim& prim, const std::string& why) {
    if (prim.type() != "GeomSubset") tell(prim, "left out with what is below it, as it is " + why);
    return false;
  }

  void add_mesh(const UsdPrim& prim, State& state) {
    UsdMesh out;
    out.path = prim.path;
    out.name = state.shown;
    out.place = prim.place();
    out.opinions = prim.opinions;
    out.to_world = state.to_world;
    out.material = state.material;
    out.transform_times = state.times;
    const Found points = prim.find("points");
    if (!points) {
      tell(prim, "a mesh without points");
      return;
    }
    out.layer = points.layer;
    if (points.property->part.empty()) {
      out.samples.push_back(points.property->value);
    } else {
      for (const auto& [time, value] : usd_samples(*points.layer, points.property->value, "points")) {
        out.times.push_back(time);
        out.samples.push_back(value);
      }
      if (out.samples.empty()) refuse(prim, "points", "has no sample");
    }
    out.mesh.positions = usd_points(out, 0);
    if (time_ && !out.times.empty()) {
      const Between between = samples_around(out.times, *time_);
      out.mesh.positions = usd_points(out, between.first);
      if (between.part > 0) out.mesh.positions += between.part * (usd_points(out, between.second) - out.mesh.positions);
    }
    read_faces(prim, out);
    read_rules(prim, out.mesh);
    read_tags(prim, out.mesh);
    read_primvars(prim, out);
    constexpr std::array<std::string_view, 2> hands{"rightHanded", "leftHanded"};
    out.left_handed = choice<bool>(prim, "orientation", hands).value_or(false);
    if (out.left_handed) {
      const std::vector<Index> from = turned_corners(out.mesh.face_sizes, out.mesh.face_vertices.size());
      turn_faces(out.mesh);
      for (UsdPrimvar& primvar : out.primvars)
        if (primvar.interpolation == UsdPrimvar::Interpolation::face_varying)
          primvar.indices = taken(primvar.indices, from);
    }
    state.mesh = static_cast<int>(meshes_.size());
    meshes_.push_back(std::move(out));
  }

  void add_subset(const UsdPrim& prim, UsdMesh& mesh) {
    const std::string element = prim.text("elementType");
    if (!element.empty() && element != "face") return tell(prim, "a subset of " + element + "s is not read");
    UsdSubset subset{.name = prim.shown_name(), .family = prim.text("familyName"), .path = prim.path};
    subset.faces = indices_of(prim, "indices", 0, mesh.mesh.num_faces() - 1);
    if (const auto materials = prim.targets("material:binding"); !materials.empty())
      subset.material = materials.front();
    mesh.subsets.push_back(std::move(subset));
  }

  UsdStage& stage_;
  std::vector<std::string>& warnings_;
  std::optional<double> time_;
  std::vector<UsdMesh> meshes_;
  std::unordered_map<std::string, State> states_;
};

}  // namespace

void turn_faces(Mesh& mesh) {
  const std::vector<Index> from = turned_corners(mesh.face_sizes, mesh.face_vertices.size());
  mesh.face_vertices = taken(mesh.face_vertices, from);
  for (Mesh::FaceVarying& channel : mesh.face_varying) channel.indices = taken(channel.indices, from);
  if (!mesh.face_normals.empty()) mesh.face_normals = taken(mesh.face_normals, from);
}

Points UsdPrimvar::expanded() const {
  Points rows(std::ssize(indices), values.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = values.row(indices[std::size_t(i)]);
  return rows;
}

std::vector<UsdMesh> usd_meshes(UsdStage& stage, std::vector<std::string>& warnings, std::optional<double> time) {
  return MeshFinder(stage, warnings, time).find();
}

Points usd_points(const UsdMesh& mesh, std::size_t sample) {
  Points points = points_of(*mesh.layer, mesh.samples[sample], mesh.place);
  if (sample > 0 && points.rows() != mesh.mesh.positions.rows())
    throw InvalidMesh(mesh.layer->place(mesh.samples[sample]) + "points: " + format_number(points.rows()) +
                      " at time " + format_number(mesh.times[sample]) + "; at the first one there are " +
                      format_number(mesh.mesh.positions.rows()));
  return points;
}

std::string component_name(const UsdPrimvar& primvar, int component) {
  if (primvar.name == "displayOpacity") return colour_names[3];
  if (primvar.name == "displayColor" && primvar.type.width == 3) return colour_names[std::size_t(component)];
  return primvar.type.width == 1 ? primvar.name : primvar.name + "_" + format_number(component);
}

}  // namespace sublimit
