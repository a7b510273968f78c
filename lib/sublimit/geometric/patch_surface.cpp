// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/patch_surface.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/nielson.h"
#include "sublimit/geometric/piper.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/source/detail/derivative_order.h"
#include "sublimit/splits/split.h"

namespace sublimit {
namespace {

constexpr std::int64_t places_per_block = 256;  // some microseconds each

/// The patch of the face that was asked for last: places come face by face.
template <class Patch>
class LastPatch {
 public:
  explicit LastPatch(const NormalMesh& mesh) : mesh_(mesh) {}
  PatchPoint<double> at(const Place& s, int order) {
    if (s.face != face_) patch_.emplace(mesh_.corners(mesh_.positions, s.face), mesh_.corners(mesh_.normals, s.face));
    face_ = s.face;
    return patch_->at(s.u, s.v, order);
  }

 private:
  const NormalMesh& mesh_;
  std::optional<Patch> patch_;
  Index face_ = -1;
};

template <class Patch>
class PatchSurface : public PlacedSurface {
 public:
  explicit PatchSurface(NormalMesh mesh) : mesh_(std::move(mesh)) {}

  FaceCount faces() const override { return {mesh_.num_faces(), true}; }

  void evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const override {
    check_order(order);
    const auto count = std::ssize(samples);
    Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv};
    for (int k = 0; k < 6; ++k) targets[k]->setZero(k == 0 || order >= (k < 3 ? 1 : 2) ? count : 0, 3);
    out.normal.setZero(normals && order >= 1 ? count : 0, 3);
    out.status.assign(size_t(count), LimitStatus::outside);
    out.order.assign(size_t(count), 0);
    parallel_for_blocks(
        count,
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          LastPatch<Patch> patch(mesh_);
          for (std::int64_t i = begin; i < end; ++i) {
            const Place& s = samples[size_t(i)];
            if (s.face < 0 || s.face >= mesh_.num_faces() || !(s.u >= 0 && s.v >= 0 && s.u + s.v <= 1)) continue;
            const PatchPoint<double> point = patch.at(s, order);
            out.status[size_t(i)] = point.status;
            out.order[size_t(i)] = static_cast<std::int8_t>(point.order);
            const Eigen::Vector3d* const found[] = {&point.position, &point.du,  &point.dv,
                                                    &point.duu,      &point.duv, &point.dvv};
            for (int k = 0; k < 6; ++k)
              if (targets[k]->rows() > 0) targets[k]->row(i) = *found[k];
            if (out.normal.rows() > 0) out.normal.row(i) = point.normal;
          }
        },
        places_per_block);
  }

 private:
  NormalMesh mesh_;
};

/// Where the vertices of a level are: for each the place in a face; face -1 for vertices without one.
struct PlacedLevel {
  std::vector<Index> triangles;
  std::vector<Place> places;
};

PlacedLevel placed_level(const NormalMesh& mesh, int levels) {
  Topology topology(view(mesh));
  std::vector<Place> corners;  // of the faces of the level, in the faces of the mesh
  corners.reserve(mesh.triangles.size());
  for (Index f = 0; f < mesh.num_faces(); ++f)
    for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)})
      corners.push_back({f, u, v});
  for (int level = 0; level < levels; ++level) {
    std::vector<Place> finer(4 * corners.size());
    for (size_t f = 0; f < corners.size() / 3; ++f) {
      const Place* x = corners.data() + 3 * f;
      Place* y = finer.data() + 12 * f;
      // Child i has corner i at position i, the middle one the point opposite to corner i: both are halves of sums.
      for (int child = 0; child < 4; ++child)
        for (int i = 0; i < 3; ++i) {
          const Place &a = child < 3 ? x[child] : x[(i + 1) % 3], &b = child < 3 ? x[i] : x[(i + 2) % 3];
          y[3 * child + i] = {x[0].face, (a.u + b.u) / 2, (a.v + b.v) / 2};
        }
    }
    corners = std::move(finer);
    Topology child = std::move(refine(topology, Split::ptq).topology);
    topology = std::move(child);
  }
  PlacedLevel result;
  result.triangles.reserve(corners.size());
  result.places.assign(size_t(topology.num_vertices()), {-1, 0, 0});
  for (Index f = 0; f < topology.num_faces(); ++f)
    for (const Index v : topology.vertices(Face{f})) {
      Place& place = result.places[size_t(v)];
      if (place.face < 0) place = corners[result.triangles.size()];
      result.triangles.push_back(v);
    }
  return result;
}

void check_patch_levels(const NormalMesh& mesh, int levels) {
  if (levels < 0) throw InvalidParameter("levels is " + format_number(levels) + "; it must be 0 or more");
  constexpr double most_triangles = std::numeric_limits<Index>::max() / 3, bytes = 400;
  const double triangles = mesh.num_faces() * std::pow(4.0, levels);
  const std::string what = format_number(levels) + " levels of " + format_number(mesh.num_faces()) + " triangles";
  const int most = most_levels(mesh.num_faces(), 4, std::min(most_triangles, memory_limit() / bytes));
  const std::string advice = "use at most " + format_number(most);
  if (triangles > most_triangles) throw ResourceError(what + " have more corners than 32-bit indices count; " + advice);
  check_memory(what, triangles * bytes, advice);
}

template <class Patch>
NormalMesh level_of(const NormalMesh& mesh, int levels) {
  check_patch_levels(mesh, levels);
  PlacedLevel level = placed_level(mesh, levels);
  const std::vector<bool> against = wound_against_normals(mesh);
  const auto count = std::ssize(level.places);
  NormalMesh result{std::move(level.triangles), Points(count, 3), Points(count, 3)};
  result.positions.topRows(mesh.num_vertices()) = mesh.positions;
  result.normals.topRows(mesh.num_vertices()) = mesh.normals;
  parallel_for_blocks(
      count - mesh.num_vertices(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        LastPatch<Patch> patch(mesh);
        for (std::int64_t i = begin + mesh.num_vertices(); i < end + mesh.num_vertices(); ++i) {
          const Place& place = level.places[size_t(i)];
          const PatchPoint<double> point = patch.at(place, 1);
          if (point.normal.isZero(0))
            throw InvalidMesh("face " + format_number(place.face) + " has no normal at (u, v) = (" +
                              format_number(place.u) + ", " + format_number(place.v) +
                              "): the normals of its corners do not suit its edges");
          result.positions.row(i) = point.position;
          result.normals.row(i) = against[size_t(place.face)] ? Eigen::Vector3d(-point.normal) : point.normal;
        }
      },
      places_per_block);
  return result;
}

std::vector<std::string> notes_on_patches(const NormalMesh& mesh) {
  Index count = 0;
  for (const bool against : wound_against_normals(mesh)) count += against;
  if (count == 0) return {};
  return {format_number(count) + " of " + format_number(mesh.num_faces()) +
          " triangles are wound against the normals of their corners; normals of samples follow the faces"};
}

}  // namespace

template <class Patch>
std::shared_ptr<const PlacedSurface> patch_surface(const NormalMesh& mesh) {
  return std::make_shared<PatchSurface<Patch>>(mesh);
}

template <class Patch>
NormalMesh patch_level(const NormalMesh& mesh, int levels) {
  return level_of<Patch>(mesh, levels);
}

GeometricNormalScheme patch_scheme(const SchemeOptions& options) {
  const OptionInfo normals{.name = "normals",
                           .values = {"given", "estimated"},
                           .meaning = "of the mesh, or means of the faces around each vertex by their angles"};
  const bool estimated = option(options, normals) == "estimated";
  GeometricNormalScheme scheme;
  scheme.checked = [estimated](NormalMesh mesh) {
    if (estimated) mesh.normals = estimated_normals(mesh);
    return checked(std::move(mesh));
  };
  scheme.notes = notes_on_patches;
  scheme.claims = {.regular = 1, .interpolates = true, .reproduces = "planes", .limit = "", .exponent = "2"};
  scheme.options = {normals};
  return scheme;
}

template std::shared_ptr<const PlacedSurface> patch_surface<NielsonPatch<double>>(const NormalMesh&);
template std::shared_ptr<const PlacedSurface> patch_surface<PiperPatch<double>>(const NormalMesh&);
template NormalMesh patch_level<NielsonPatch<double>>(const NormalMesh&, int);
template NormalMesh patch_level<PiperPatch<double>>(const NormalMesh&, int);

}  // namespace sublimit
