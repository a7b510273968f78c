// SPDX-License-Identifier: Apache-2.0
#pragma once
// Places on patches and curves by their own parameters, from a CSV:
//
//   patch,u,v          a place at a knot is on the piece to its right; at the end of the domain to its left
//   patch,u,v,side     side: two characters for u and v, `+` right, `-` left; or empty
//   curve,t            places on curves
//   curve,t,side       side: one character
//
// Results are written after these columns, with derivatives per unit of these parameters.
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/source/linear_source.h"
#include "sublimit/stencils/formats/csv_rows.h"

namespace sublimit {

/// Places of a batch in their own parameters, as the file has them.
struct OwnPlaces {
  bool has_sides = false;
  std::vector<Index> patches;
  std::vector<Patch::Parameters> parameters;
  std::vector<std::string> sides;       ///< words of the file
  std::vector<Patch::Lengths> lengths;  ///< lengths of the faces of the places

  std::string header() const { return has_sides ? "patch,u,v,side" : "patch,u,v"; }
  void append(std::string& out, size_t i) const;
  /// Scales derivatives from units of faces to units of the parameters.
  void scale(LimitSamples& found) const;
};

class OwnPlaceReader {
 public:
  /// @throws IoError;  FormatError  another header
  explicit OwnPlaceReader(const std::filesystem::path& path);
  /// @throws FormatError  rows that are no places, with file:line: a patch that does not exist, parameters outside its
  ///                      domain or not finite, other sides
  void read(std::vector<Place>& batch, OwnPlaces& places, size_t most, const PatchSet& patches);

 private:
  CsvRows rows_;
};

/// Returns the place on a face of the set for a place by the parameters of a patch.
/// @param where  start of messages: "FILE:LINE: "
/// @throws FormatError  a patch that does not exist, parameters outside its domain
Place own_place(const PatchSet& patches, std::int64_t patch, const Patch::Parameters& at, const std::string& where);

/// Places on curves in their own parameters.
struct OwnCurvePlaces {
  bool has_sides = false;
  std::vector<Index> curves;
  std::vector<double> parameters;
  std::vector<std::string> sides;  ///< words of the file
  std::vector<double> lengths;     ///< lengths of the segments of the places

  std::string header() const { return has_sides ? "curve,t,side" : "curve,t"; }
  void append(std::string& out, size_t i) const;
  /// Scales derivatives from units of segments to units of the parameter.
  void scale(CurveSamples& found) const;
};

class OwnCurvePlaceReader {
 public:
  /// @throws IoError;  FormatError  another header
  explicit OwnCurvePlaceReader(const std::filesystem::path& path);
  /// Returns true if the file has a column of sides, by its header.
  bool has_sides() const { return rows_.columns().size() == 3; }
  /// @throws FormatError  rows that are no places, as OwnPlaceReader
  void read(std::vector<CurvePlace>& batch, OwnCurvePlaces& places, size_t most, const CurveSet& curves);

 private:
  CsvRows rows_;
};

/// Returns true if the first line of a CSV begins with this column: `patch` or `curve`.
bool has_own_places(const std::filesystem::path& path, std::string_view column);

}  // namespace sublimit
