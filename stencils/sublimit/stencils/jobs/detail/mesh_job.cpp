// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/jobs/detail/mesh_job.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"
#include "sublimit/scheme/any_scheme.h"
#include "sublimit/scheme/detail/prepare.h"
#include "sublimit/stencils/formats/rule_of_word.h"

namespace sublimit {
namespace {

/// The rule of a word; nothing of an empty one.
template <class Rule>
std::optional<Rule> rule(const char* what, const std::string& word, std::span<const char* const> words) {
  const std::optional<Rule> found = rule_of<Rule>(word);
  if (found || word.empty()) return found;
  std::string all;
  for (const char* other : words) all += (all.empty() ? "" : ", ") + std::string(other);
  throw InvalidOption(std::string(what) + " '" + word + "' is no rule; there are " + all);
}

/// Returns numbers as words, the first of them if they are many.
std::string some_of(const std::vector<Index>& numbers) {
  constexpr size_t most = 20;
  std::string all;
  for (size_t i = 0; i < std::min(numbers.size(), most); ++i) all += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return all + (numbers.size() > most ? ", ..." : "");
}

/// Does to winding and tags what is asked, and notes it.
void change_mesh(const MeshRequest& request, Mesh& mesh, const std::string& name, std::vector<std::string>& notes) {
  const auto note = [&](const std::string& what) { notes.push_back(name + ": " + what); };
  const auto sharp = [](Index count) {
    return std::to_string(count) + (count == 1 ? " edge" : " edges") + " made sharp";
  };
  if (request.orient) {
    const std::vector<Index> turned = orient_faces(mesh);
    note(turned.empty() ? "no face had to be turned"
                        : std::to_string(turned.size()) + (turned.size() == 1 ? " face" : " faces") +
                              " turned: " + some_of(turned));
  }
  if (request.crease_angle) {
    const double degrees = *request.crease_angle;
    if (!(degrees >= 0 && degrees <= 180))
      throw InvalidOption("crease-angle is " + format_number(degrees) + "; it should be 0 to 180 degrees");
    note(sharp(add_creases_by_angle(mesh, degrees * std::numbers::pi / 180)) + " by their angle");
  }
  if (request.crease_smoothing_groups) note(sharp(add_creases_by_smoothing_groups(mesh)) + " between smoothing groups");
  if (request.boundary == fixed_boundary) fix_border(mesh);
}

}  // namespace

Scheme<double> scheme_or_throw(const std::string& name, const SchemeOptions& options) {
  if (std::optional<Scheme<double>> scheme = find_scheme(name, options)) return *std::move(scheme);
  throw_no_surface_scheme(name);
}

MeshJob scheme_job(const MeshRequest& request) {
  MeshJob job;
  if (request.boundary == fixed_boundary)
    job.rules.boundary = Boundary::edge_only;
  else
    job.rules.boundary = rule<Boundary>("boundary", request.boundary, boundary_and_fixed_words);
  job.rules.creasing = rule<Creasing>("creasing", request.creasing, creasing_words);
  rule<Attributes>("attributes", request.attributes, attributes_words);
  const auto triangles = rule<Triangles>("triangles", request.triangles, triangles_words);
  const auto face_varying = rule<FaceVaryingInterpolation>("face-varying", request.face_varying, face_varying_words);
  job.face_varying_asked = face_varying.has_value();
  job.face_varying = face_varying.value_or(FaceVaryingInterpolation::all);
  job.options = request.options;
  if (triangles) job.options["triangles"] = request.triangles;
  if (request.own_scheme) {
    job.scheme = *request.own_scheme;
    check_options(job.scheme->name, job.scheme->options, job.options);
  } else if (!request.scheme.empty()) {
    job.scheme = scheme_or_throw(request.scheme, job.options);
  }
  return job;
}

MeshJob mesh_job(const MeshRequest& request, Mesh mesh, const std::string& name) {
  MeshJob job = scheme_job(request);
  job.notes = mesh.notes;
  if (const auto asked = rule<Attributes>("attributes", request.attributes, attributes_words)) mesh.attributes = asked;
  if (request.no_creases) mesh = without_creases(std::move(mesh));
  const std::size_t tagged_corners = mesh.corners.size();
  change_mesh(request, mesh, name, job.notes);
  if (request.triangulate) mesh = triangulated(mesh);
  if (const auto asked = job.options.find("triangles"); asked != job.options.end()) {
    mesh.triangles = rule_of<Triangles>(asked->second);
  } else if (job.scheme && !request.own_scheme) {
    job.scheme = *AnyScheme(*std::move(job.scheme)).for_mesh(mesh);
    job.options = job.scheme->chosen;
  }
  if (job.scheme) mesh.scheme = job.scheme->name;
  if (request.boundary == fixed_boundary && job.scheme && job.scheme->is_dual() && mesh.corners.size() > tagged_corners)
    throw InvalidOption("boundary 'fixed': " + job.scheme->name +
                        " keeps no vertices, so that those of the border cannot stay; leave it out, or use a scheme "
                        "that keeps them, such as catmull-clark or loop");
  if (job.rules.boundary) mesh.boundary = job.rules.boundary;
  if (job.rules.creasing) mesh.creasing = job.rules.creasing;
  if (!mesh.knot_intervals.empty() && job.scheme && job.scheme->knots == NewKnots::none)
    mesh.warnings.push_back(name + ": knot intervals ignored: " + job.scheme->name +
                            " knows none; catmull-clark-intervals and doo-sabin-intervals do");
  if (!job.face_varying_asked) job.face_varying = mesh.face_varying_interpolation.value_or(job.face_varying);
  if (request.strict) {
    std::string all;
    for (const std::string& fault : faults(mesh, request.orient)) all += "\n  " + fault;
    if (!all.empty()) throw InvalidMesh(name + ": not a clean manifold:" + all);
    for (const std::string& warning : mesh.warnings) all += "\n  " + warning;
    if (!all.empty()) throw InvalidMesh(name + ": refused, since it has warnings:" + all);
  }
  job.mesh = std::move(mesh);
  return job;
}

std::vector<std::string> faults(const Mesh& mesh, bool turned) {
  const Topology topology(view(mesh));
  std::vector<std::string> all;
  for (const Topology::Fault& fault : topology.faults()) {
    std::string message = fault.message;
    if (turned && fault.kind == Topology::Fault::Kind::inconsistent_winding)
      message.replace(message.rfind("; "), std::string::npos,
                      "; turning faces does not help: the surface has a single side, as a Moebius band has");
    all.push_back(std::move(message));
  }
  return all;
}

}  // namespace sublimit
