// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control polygons as text, read and written to the same bits.
//
// CSV: a point a line, coordinates of any dimension separated by commas. The first line may have names; a blank line
// begins another curve; '#' starts a comment. Points with tangents (schemes that take them) have twice the columns, all
// coordinates first: x,y,tx,ty. The format has no word for closed curves, so the caller says.
//
// OBJ: `v x y z` and `l a b c ...`, one curve a line statement, indices as in faces (negative ones count backwards); a
// curve that comes back to its first point is closed. Lines of two points, each from where the one before ended, are
// one curve.
#include <filesystem>
#include <string>
#include <string_view>

#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// Reads the polygon of a .csv or .obj file.
/// @param tangents  the columns of a CSV are points and tangents
/// @throws FormatError  what cannot be understood, with file:line and what would be right; another extension
/// @throws InvalidMesh  numbers that are not finite, indices out of range, no curves;  IoError  missing, unreadable
ControlPolygon read_polygon(const std::filesystem::path& path, bool tangents = false);

/// Reads a control polygon from text; messages start with `name`.
ControlPolygon parse_polygon_csv(std::string_view text, std::string_view name, bool tangents = false);
ControlPolygon parse_polygon_obj(std::string_view text, std::string_view name);

/// Returns a polygon as the text of a file. Numbers have the shortest form that reads back to the same bits; rows of
/// tangents that are not finite become empty fields.
/// @throws InvalidParameter  an OBJ of points with more than 3 coordinates;  InvalidMesh  points that are not finite
std::string format_polygon_csv(const ControlPolygon& polygon);
std::string format_polygon_obj(const ControlPolygon& polygon);

/// Writes a polygon to a .csv or .obj file, which appears whole or not at all.
void write_polygon(const std::filesystem::path& path, const ControlPolygon& polygon);

}  // namespace sublimit
