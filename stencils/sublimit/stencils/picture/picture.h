// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pictures of meshes as SVG: panels in rows, one camera, soft shading, hidden faces and lines left out. Faces
// that a depth buffer shows to be hidden are not written, faces of equal tone are merged into one outline, and
// coordinates are tenths of a pixel, so that a limit surface of 20 000 faces takes about 200 KB.
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/stencils/picture/color.h"

namespace sublimit {

struct PictureMesh {
  Points positions;                  ///< #V x 3
  std::vector<Index> face_sizes;     ///< corners of each face, >= 3
  std::vector<Index> face_vertices;  ///< vertices of all faces, one after the other, counter-clockwise

  /// Normals per vertex, per corner, both, or none. Faces without normals, or with zero ones, are flat. Lengths
  /// do not matter. A normal far from that of its face belongs to the other side of a crease and is not used
  /// for the face.
  Points vertex_normals;  ///< #V x 3
  Points corner_normals;  ///< one row per entry of face_vertices

  struct Line {
    Index tail = 0, head = 0;
    double strength = 1;  ///< 0 to 1: from thin amber to strong red
  };
  std::vector<Line> creases;
  struct Ink {
    Color color = {};
    double width = 1;  ///< pixels, 0..5
  };
  std::optional<Ink> ink;   ///< ink of all creases, for any sharpness
  std::vector<Index> dots;  ///< vertices to mark
  double dot_size = 1;      ///< 0..2

  bool faces = true;       ///< false: lines and dots only, which hide nothing
  bool wireframe = false;  ///< draw all edges
  Color color = {.42, .60, .70};
};

/// Lines and discs of one colour and width, point by point, which hide nothing.
class Strokes {
 public:
  Strokes(const Color& color, double width) {
    mesh_.faces = false;
    mesh_.ink = {color, width};
  }
  /// Adds a point, and returns its number.
  Index add(const Eigen::Vector3d& p) {
    points_.push_back(p);
    return static_cast<Index>(points_.size()) - 1;
  }
  /// Adds a line between points that were added.
  void line(Index a, Index b) { mesh_.creases.push_back({a, b}); }
  /// Adds a line.
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Index tail = add(a);
    line(tail, add(b));
  }
  /// Adds a line through points; #x3.
  void polyline(const Points& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Index next = add(points.row(i));
      if (i > 0) line(next - 1, next);
    }
  }
  /// Adds a disc, as wide as lines: a line without length has round ends.
  void dot(const Eigen::Vector3d& p) { line(p, p); }
  /// Returns all of them as a layer of a panel.
  PictureMesh mesh() const {
    PictureMesh mesh = mesh_;
    mesh.positions.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i)
      mesh.positions.row(static_cast<Eigen::Index>(i)) = points_[i].transpose();
    return mesh;
  }

 private:
  PictureMesh mesh_;
  std::vector<Eigen::Vector3d> points_;
};

struct Panel {
  std::vector<PictureMesh> layers;
  std::string caption;
  std::string note;  ///< a second, smaller line
};

struct PictureOptions {
  double panel_width = 400, panel_height = 370;  ///< pixels, captions not included
  Eigen::Vector3d up = {0, 1, 0};
  double azimuth = .6, elevation = .36;  ///< direction of the eye, radians; at azimuth 0, +x is to the right
  double distance = 5;                   ///< distance of the eye, in radii of the scene, > 1; 0: orthographic
  int sky_directions = 128;              ///< number of directions of light; more take time and reduce grain
  int tone_step = 1;                     ///< step between tones of smooth shading; larger for small pictures
  bool ground_shadow = true;
  bool plate = true;         ///< a light background
  double caption_size = 17;  ///< pixels; notes are smaller
  /// Alternative text. With a title the picture has the role of an image of that name, as inline pictures need.
  std::string title = {}, description = {};
  int columns = 0;  ///< panels in a row, 0: all
  /// Points #x3 that are kept in view but not drawn. Pictures whose contents are within the same points have
  /// the same camera.
  Points in_view = {};
};

/// Returns the text of an SVG file.
///
/// Every panel shows the union of its layers; scale and camera are the same for all panels.
/// @throws InvalidParameter  if a coordinate or normal is not finite, arrays do not fit together, an index is outside
///                           its array, or an option is outside its range
/// @note  Deterministic: same build and input, same bytes.
std::string svg_picture(const std::vector<Panel>& panels, const PictureOptions& options = {});

}  // namespace sublimit
