// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/patch_places.h"

#include <fstream>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit {
namespace {

/// The patch or curve of a row: its first column.
/// @param plural  for messages
Index own_number(const CsvRows& rows, const char* plural, std::int64_t count) {
  const std::string known = plural + (" are 0 to " + format_number(count - 1));
  const std::int64_t number = rows.integer(0, known);
  if (number < 0 || number >= count)
    throw FormatError(rows.place() + rows.columns()[0] + " " + format_number(number) + " does not exist; " + known);
  return static_cast<Index>(number);
}

/// The side of one of the parameters of a row.
/// @param sides  its last column: empty, or a character for each parameter
/// @param right  what it should be, in words
KnotSide own_side(const CsvRows& rows, const std::string& sides, size_t parameter, size_t parameters,
                  const char* right) {
  if (sides.empty()) return KnotSide::right;
  if (sides.size() != parameters || (sides[parameter] != '+' && sides[parameter] != '-'))
    throw FormatError(rows.place() + "side '" + sides + "'; it should be " + right + ", or empty");
  return sides[parameter] == '-' ? KnotSide::left : KnotSide::right;
}

}  // namespace

void OwnPlaces::append(std::string& out, size_t i) const {
  append_number(out, patches[i]);
  out += ',';
  append_number(out, parameters[i].u);
  out += ',';
  append_number(out, parameters[i].v);
  if (has_sides) out += ',' + sides[i];
}

void OwnPlaces::scale(LimitSamples& found) const {
  const auto divide = [&](Points& rows, auto&& of) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) /= of(lengths[size_t(i)]);
  };
  using Lengths = const Patch::Lengths&;
  divide(found.du, [](Lengths l) { return l.u; });
  divide(found.dv, [](Lengths l) { return l.v; });
  divide(found.duu, [](Lengths l) { return l.u * l.u; });
  divide(found.duv, [](Lengths l) { return l.u * l.v; });
  divide(found.dvv, [](Lengths l) { return l.v * l.v; });
}

OwnPlaceReader::OwnPlaceReader(const std::filesystem::path& path)
    : rows_(path, {{"patch", "u", "v"}, {"patch", "u", "v", "side"}}, "face,u,v or patch,u,v or patch,u,v,side") {}

Place own_place(const PatchSet& patches, std::int64_t patch, const Patch::Parameters& at, const std::string& where) {
  const auto count = static_cast<Index>(patches.members().size());
  if (patch < 0 || patch >= count)
    throw FormatError(where + "patch " + format_number(patch) + " does not exist; patches are 0 to " +
                      format_number(count - 1));
  try {
    Place sample = patches.members()[size_t(patch)].patch->place(at);
    sample.face += patches.first_face(size_t(patch));
    return sample;
  } catch (const InvalidParameter& error) {
    throw FormatError(where + error.what());
  }
}

void OwnPlaceReader::read(std::vector<Place>& batch, OwnPlaces& places, size_t most, const PatchSet& patches) {
  const std::int64_t count = std::ssize(patches.members());
  batch.clear();
  places = {};
  places.has_sides = rows_.columns().size() == 4;
  while (batch.size() < most && rows_.next()) {
    const Index patch = own_number(rows_, "patches", count);
    Patch::Parameters at{.u = rows_.finite(1), .v = rows_.finite(2)};
    const std::string sides = places.has_sides ? std::string(rows_.text(3)) : std::string();
    at.u_side = own_side(rows_, sides, 0, 2, "two of + and -, of u and of v");
    at.v_side = own_side(rows_, sides, 1, 2, "two of + and -, of u and of v");
    batch.push_back(own_place(patches, patch, at, rows_.place()));
    places.lengths.push_back(patches.lengths(batch.back().face));
    places.patches.push_back(patch);
    places.parameters.push_back(at);
    places.sides.push_back(sides);
  }
}

void OwnCurvePlaces::append(std::string& out, size_t i) const {
  append_number(out, curves[i]);
  out += ',';
  append_number(out, parameters[i]);
  if (has_sides) out += ',' + sides[i];
}

void OwnCurvePlaces::scale(CurveSamples& found) const {
  for (Eigen::Index i = 0; i < found.first.rows(); ++i) found.first.row(i) /= lengths[size_t(i)];
  for (Eigen::Index i = 0; i < found.second.rows(); ++i) found.second.row(i) /= lengths[size_t(i)] * lengths[size_t(i)];
}

OwnCurvePlaceReader::OwnCurvePlaceReader(const std::filesystem::path& path)
    : rows_(path, {{"curve", "t"}, {"curve", "t", "side"}}, "segment,t or curve,t or curve,t,side") {}

void OwnCurvePlaceReader::read(std::vector<CurvePlace>& batch, OwnCurvePlaces& places, size_t most,
                               const CurveSet& curves) {
  batch.clear();
  places = {};
  places.has_sides = has_sides();
  while (batch.size() < most && rows_.next()) {
    const Index curve = own_number(rows_, "curves", curves.num_curves());
    const double t = rows_.finite(1);
    const std::string side = places.has_sides ? std::string(rows_.text(2)) : std::string();
    const LinearCurve& own = curves.curve(curve);
    try {
      CurvePlace sample = own.place(t, own_side(rows_, side, 0, 1, "+ or -"));
      places.lengths.push_back(own.length(sample.segment));
      sample.segment += curves.first_segment(curve);
      batch.push_back(sample);
    } catch (const InvalidParameter& error) {
      throw FormatError(rows_.place() + "curve " + format_number(curve) + ": " + error.what());
    }
    places.curves.push_back(curve);
    places.parameters.push_back(t);
    places.sides.push_back(side);
  }
}

bool has_own_places(const std::filesystem::path& path, std::string_view column) {
  if (all_formats().reads(path, contents::arrays)) {
    const std::vector<std::string> names = NpyRows(path).columns();
    return std::ranges::find(names, column) != names.end();
  }
  std::ifstream file(opened_path(path));
  std::string line;
  std::getline(file, line);
  const size_t begin = line.find_first_not_of(" \t\xef\xbb\xbf");
  return begin != std::string::npos && line.compare(begin, column.size(), column) == 0;
}

}  // namespace sublimit
