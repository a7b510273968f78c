// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/picture.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int supersampling = 5;  // depth samples per pixel and direction
constexpr int units = 10;         // SVG units per pixel: one decimal without a decimal point
constexpr int tones = 112;        // steps of a colour ramp; fewer would show as bands
constexpr double crease_angle = 35 * std::numbers::pi / 180;  // normals further from the face's are the other side's

// ---- Input

void require(bool condition, int panel, int layer, const char* what) {
  if (condition) return;
  throw InvalidParameter("picture: panel " + std::to_string(panel) + ", layer " + std::to_string(layer) + ": " + what);
}

void check(const PictureMesh& mesh, int panel, int layer) {
  const auto need = [&](bool condition, const char* what) { require(condition, panel, layer, what); };
  const Eigen::Index count = mesh.positions.rows();
  const auto inside = [&](Index v) { return v >= 0 && v < count; };
  need(count == 0 || mesh.positions.cols() == 3, "positions need 3 columns");
  need(mesh.positions.allFinite(), "a coordinate is not finite");
  std::size_t corners = 0;
  for (Index size : mesh.face_sizes) {
    need(size >= 3, "a face has fewer than 3 corners");
    corners += static_cast<std::size_t>(size);
  }
  need(corners == mesh.face_vertices.size(), "face_sizes do not add up to the length of face_vertices");
  need(std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(), inside),
       "a face has a vertex that does not exist");
  need(std::all_of(mesh.dots.begin(), mesh.dots.end(), inside), "a dot is a vertex that does not exist");
  for (const PictureMesh::Line& line : mesh.creases) {
    need(inside(line.tail) && inside(line.head), "a crease has a vertex that does not exist");
    need(line.strength >= 0 && line.strength <= 1, "a crease's strength is outside 0..1");
  }
  for (double c : mesh.color) need(c >= 0 && c <= 1, "a colour is outside 0..1");
  const auto normals = [&](const Points& n, Eigen::Index rows) {
    need(n.size() == 0 || (n.rows() == rows && n.cols() == 3),
         "normals need 3 columns and one row per vertex or corner");
    need(n.allFinite(), "a normal is not finite");
  };
  normals(mesh.vertex_normals, count);
  normals(mesh.corner_normals, static_cast<Eigen::Index>(corners));
}

void check(const PictureOptions& o) {
  const auto need = [](bool condition, const char* what) {
    if (!condition) throw InvalidParameter(std::string("picture: ") + what);
  };
  const auto size = [](double pixels) { return pixels >= 16 && pixels <= 4096; };
  need(size(o.panel_width) && size(o.panel_height), "a panel's width and height are 16 to 4096 pixels");
  need(o.up.allFinite() && o.up.norm() > 0, "the direction up is not finite or zero");
  need(std::isfinite(o.azimuth) && std::isfinite(o.elevation), "azimuth and elevation must be finite");
  need(o.distance == 0 || (o.distance > 1 && o.distance <= 1e6), "distance must be 0 or greater than 1");
}

// ---- Camera

/// The box that is shown: centre and half of its largest side. Written so that huge coordinates do not overflow.
struct Frame {
  Vector3d half_center = Vector3d::Zero();
  double half_size = 1;
  Vector3d local(const Vector3d& p) const { return (p / 2 - half_center) / (half_size / 2); }
};

Frame frame_of(const std::vector<Panel>& panels) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Panel& panel : panels) {
    for (const PictureMesh& mesh : panel.layers) {
      const auto add = [&](Index v) {
        const Vector3d p = mesh.positions.row(v);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      };
      for (Index v : mesh.face_vertices) add(v);
      for (const PictureMesh::Line& line : mesh.creases) add(line.tail), add(line.head);
      for (Index v : mesh.dots) add(v);
    }
  }
  Frame frame;
  if (!(low.x() <= high.x())) return frame;  // nothing to show
  frame.half_center = low / 4 + high / 4;
  const double size = (high / 2 - low / 2).maxCoeff();
  if (size > 0) frame.half_size = size;
  return frame;
}

/// A point as the depth buffer wants it: pixels, y down, and a nearness that is linear on the screen.
struct Projected {
  double x = 0, y = 0, near = 0;
};

struct Camera {
  Eigen::Matrix3d axes;  // rows: right, up, towards the eye
  Vector3d up;
  double distance;   // 0: orthographic
  double scale = 1;  // pixels per unit at the centre
  Vector2d shift = Vector2d::Zero();

  explicit Camera(const PictureOptions& o) : up(o.up.normalized()), distance(o.distance * std::sqrt(3.)) {
    const Vector3d x = std::abs(up.x()) < .9 ? Vector3d::UnitX() : Vector3d::UnitZ();
    const Vector3d front = x.cross(up).normalized(), side = up.cross(front);
    const double elevation = std::clamp(o.elevation, -1.55, 1.55);
    const Vector3d eye =
        std::cos(elevation) * (std::cos(o.azimuth) * front + std::sin(o.azimuth) * side) + std::sin(elevation) * up;
    axes.row(2) = eye;
    axes.row(0) = up.cross(eye).normalized();
    axes.row(1) = eye.cross(Vector3d(axes.row(0)));
  }
  Vector3d seen(const Vector3d& p) const { return axes * p; }
  Projected project(const Vector3d& v) const {
    const double ratio = distance > 0 ? distance / (distance - v.z()) : 1;
    return {scale * ratio * v.x() + shift.x(), -scale * ratio * v.y() + shift.y(),
            distance > 0 ? distance * ratio : v.z()};
  }
  /// Is the outside of a plane with this normal at this point (both seen) towards the eye?
  bool faces_eye(const Vector3d& normal, const Vector3d& point) const {
    return distance > 0 ? normal.dot(Vector3d(0, 0, distance) - point) > 0 : normal.z() > 0;
  }
};

// ---- What is in a panel, in the camera's coordinates

struct SceneFace {
  int begin = 0, end = 0;  // corners
  int layer = 0;
  Vector3d center = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  // of the side that is seen
  bool back = false;                   // that side is the inside
  bool solid = true, flat = true;
  double light = 1;  // how much of the sky it sees
  double tone = 0;   // at the centre, 0..tones - 1
};

struct SceneCorner {
  int point = 0;
  Vector3d normal = Vector3d::Zero();
  double light = 1;
  double tone = 0;
};

struct Scene {
  std::vector<Vector3d> points;
  std::vector<int> first_point;  // of each layer
  std::vector<SceneCorner> corners;
  std::vector<SceneFace> faces;

  const Vector3d& point(int corner) const { return points[corners[corner].point]; }
  static int next(const SceneFace& face, int corner) { return corner + 1 < face.end ? corner + 1 : face.begin; }
};

Scene scene_of(const Panel& panel, const Frame& frame, const Camera& camera) {
  Scene scene;
  for (int l = 0; l < static_cast<int>(panel.layers.size()); ++l) {
    const PictureMesh& mesh = panel.layers[l];
    const int first = static_cast<int>(scene.points.size());
    scene.first_point.push_back(first);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
      scene.points.push_back(camera.seen(frame.local(mesh.positions.row(v))));
    int corner = 0;
    for (Index size : mesh.face_sizes) {
      SceneFace face;
      face.begin = static_cast<int>(scene.corners.size());
      face.end = face.begin + size;
      face.layer = l;
      face.solid = mesh.faces;
      face.flat = mesh.vertex_normals.size() == 0 && mesh.corner_normals.size() == 0;
      for (int i = 0; i < size; ++i) scene.corners.push_back({.point = first + mesh.face_vertices[corner + i]});
      for (int c = face.begin; c < face.end; ++c) face.center += scene.point(c) / size;
      for (int c = face.begin; c < face.end; ++c) {
        face.normal += (scene.point(c) - face.center).cross(scene.point(scene.next(face, c)) - face.center);
      }
      face.normal.normalize();
      face.back = !camera.faces_eye(face.normal, face.center);
      for (int i = 0; i < size; ++i) {
        Vector3d n = Vector3d::Zero();
        if (mesh.corner_normals.size() > 0) n = mesh.corner_normals.row(corner + i);
        if (n.isZero() && mesh.vertex_normals.size() > 0) n = mesh.vertex_normals.row(mesh.face_vertices[corner + i]);
        n = camera.seen(n.stableNormalized());
        if (!(n.dot(face.normal) > std::cos(crease_angle))) n = face.normal;
        scene.corners[face.begin + i].normal = face.back ? Vector3d(-n) : n;
      }
      if (face.back) face.normal = -face.normal;
      corner += size;
      scene.faces.push_back(face);
    }
  }
  return scene;
}

// ---- Depth buffer

class DepthBuffer {
 public:
  DepthBuffer(int width, int height)
      : width_(width),
        height_(height),
        near_(static_cast<std::size_t>(width) * height, -std::numeric_limits<float>::infinity()),
        face_(near_.size(), -1) {}

  void draw(const Projected& a, const Projected& b, const Projected& c, int face) {
    scan(a, b, c, [&](std::size_t pixel, float near) {
      if (near > near_[pixel]) near_[pixel] = near, face_[pixel] = face;
    });
  }
  /// Calls `use(pixel, nearness)` for every sample inside a triangle.
  template <class Use>
  void scan(const Projected& a, const Projected& b, const Projected& c, Use use) const {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - .5)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - .5)));
    const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - .5)));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - .5)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + .5, py = y + .5;
        const double u = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double v = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        use(static_cast<std::size_t>(y) * width_ + x,
            static_cast<float>(a.near + u * (b.near - a.near) + v * (c.near - a.near)));
      }
    }
  }
  /// Every sample the nearest of itself and its eight neighbours.
  std::vector<float> nearest_around() const {
    std::vector<float> rows = near_, result(near_.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
        rows[pixel] = std::max({near_[pixel - (x > 0)], near_[pixel], near_[pixel + (x + 1 < width_)]});
      }
    }
    for (int y = 0; y < height_; ++y) {
      const std::size_t above = y > 0 ? width_ : 0, below = y + 1 < height_ ? width_ : 0;
      for (int x = 0; x < width_; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
        result[pixel] = std::max({rows[pixel - above], rows[pixel], rows[pixel + below]});
      }
    }
    return result;
  }
  float near(std::size_t pixel) const { return near_[pixel]; }
  int face(std::size_t pixel) const { return face_[pixel]; }
  /// Share of the samples at (x, y) and beside it of which `open(face, nearness)` is true.
  template <class Open>
  double share_around(double x, double y, Open open) const {
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    int count = 0, all = 0;
    for (int j = std::max(0, cy - 1); j <= std::min(height_ - 1, cy + 1); ++j) {
      for (int i = std::max(0, cx - 1); i <= std::min(width_ - 1, cx + 1); ++i) {
        const std::size_t pixel = static_cast<std::size_t>(j) * width_ + i;
        count += open(face_[pixel], near_[pixel]);
        ++all;
      }
    }
    return all > 0 ? static_cast<double>(count) / all : 0;
  }

 private:
  int width_, height_;
  std::vector<float> near_;
  std::vector<int> face_;
};

/// Triangles of a face: two for a quad, a fan around the centre for more corners.
template <class Use>
void for_each_triangle(const Scene& scene, const SceneFace& face, const std::vector<Projected>& at,
                       const Projected& center, Use use) {
  const int size = face.end - face.begin;
  const auto corner = [&](int i) -> const Projected& { return at[scene.corners[face.begin + i % size].point]; };
  if (size <= 4) {
    for (int i = 1; i + 1 < size; ++i) use(corner(0), corner(i), corner(i + 1));
  } else {
    for (int i = 0; i < size; ++i) use(center, corner(i), corner(i + 1));
  }
}

// ---- Light

/// How much of the sky every face sees: depth buffers from many directions, weighted by the cosine law and a brighter
/// zenith.
void light_from_sky(Scene& scene, const Camera& camera) {
  constexpr int directions = 128, size = 256;
  std::vector<double> seen(scene.faces.size(), 0), all(scene.faces.size(), 0);
  const Vector3d zenith = camera.seen(camera.up);
  std::vector<Projected> at(scene.points.size());
  for (int d = 0; d < directions; ++d) {
    const double z = 1 - (2 * d + 1) / static_cast<double>(directions), r = std::sqrt(1 - z * z);
    const double angle = d * std::numbers::pi * (3 - std::sqrt(5.));  // golden angle: evenly spread over the sphere
    const Vector3d to_light(r * std::cos(angle), r * std::sin(angle), z);
    const double weight = .65 + .35 * to_light.dot(zenith);
    const Vector3d right = to_light.unitOrthogonal(), upward = to_light.cross(right);
    constexpr double scale = size / 3.6;  // the scene lies in a sphere of radius sqrt(3)
    const auto project = [&](const Vector3d& p) {
      return Projected{size / 2. + scale * p.dot(right), size / 2. + scale * p.dot(upward), p.dot(to_light)};
    };
    DepthBuffer buffer(size, size);
    std::transform(scene.points.begin(), scene.points.end(), at.begin(), project);
    for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
      const SceneFace& face = scene.faces[f];
      if (!face.solid) continue;
      for_each_triangle(scene, face, at, project(face.center),
                        [&](const Projected& a, const Projected& b, const Projected& c) { buffer.draw(a, b, c, f); });
    }
    for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
      const SceneFace& face = scene.faces[f];
      const double cosine = face.normal.dot(to_light);
      if (cosine <= 0) continue;
      const Projected p = project(face.center + .03 * face.normal);
      const double w = weight * cosine;
      all[f] += w;
      const auto open = [&](int other, float near) { return other == f || near <= p.near + .02; };
      seen[f] += w * buffer.share_around(p.x, p.y, open);
    }
  }
  for (std::size_t f = 0; f < scene.faces.size(); ++f) scene.faces[f].light = all[f] > 0 ? seen[f] / all[f] : 0;

  // Means over the faces around a vertex, as far as they are smooth there, take the grain away.
  std::vector<std::vector<int>> around(scene.points.size());
  for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
    const SceneFace& face = scene.faces[f];
    for (int c = face.begin; c < face.end; ++c) around[scene.corners[c].point].push_back(f);
  }
  for (int pass = 0; pass < 6; ++pass) {
    for (const SceneFace& face : scene.faces) {
      for (int c = face.begin; c < face.end; ++c) {
        double sum = 0;
        int count = 0;
        for (int g : around[scene.corners[c].point]) {
          const SceneFace& other = scene.faces[g];
          if (&other != &face && other.normal.dot(face.normal) < std::cos(crease_angle)) continue;
          sum += other.light;
          ++count;
        }
        scene.corners[c].light = sum / count;
      }
    }
    for (SceneFace& face : scene.faces) {
      if (face.flat && pass > 0) continue;
      double sum = 0;
      for (int c = face.begin; c < face.end; ++c) sum += scene.corners[c].light;
      face.light = sum / (face.end - face.begin);
    }
  }
}

/// Tone of a point: a key light from the upper left, a fill from the right, the sky, a soft highlight.
double tone(const Vector3d& point, const Vector3d& n, double light, bool back, const Camera& camera) {
  const Vector3d key = Vector3d(-.50, .62, .60).normalized(), fill = Vector3d(.85, .05, .5).normalized();
  const Vector3d eye =
      camera.distance > 0 ? Vector3d(Vector3d(0, 0, camera.distance) - point).normalized() : Vector3d::UnitZ();
  const double sky = .5 + .5 * n.dot(camera.seen(camera.up));
  const auto shine = [&](const Vector3d& from, double width) {
    return std::pow(std::max(0., n.dot((from + eye).normalized())), width);
  };
  const Vector3d window = Vector3d(-.85, .10, .75).normalized();
  const double value = .07 + light * (.20 * sky + .46 * std::max(0., n.dot(key)) + .12 * std::max(0., n.dot(fill)) +
                                      .28 * shine(key, 50) + .20 * shine(window, 45));
  return std::clamp(back ? .12 + .5 * value : value, 0., 1.) * (tones - 1);
}

void set_tones(Scene& scene, const Camera& camera) {
  for (SceneFace& face : scene.faces) {
    const int size = face.end - face.begin;
    for (int c = face.begin; c < face.end; ++c) {
      SceneCorner& corner = scene.corners[c];
      corner.tone = face.flat ? std::round(tone(face.center, face.normal, face.light, face.back, camera))
                              : tone(scene.point(c), corner.normal, corner.light, face.back, camera);
      face.tone += corner.tone / size;
    }
  }
}

Color mix(const Color& a, const Color& b, double t) {
  Color c;
  for (int i = 0; i < 3; ++i) c[i] = a[i] + t * (b[i] - a[i]);
  return c;
}

/// From a cool shadow through the colour itself to a warm white, without a kink.
Color ramp(const Color& base, double t) {
  const Color dark = mix({.09, .10, .19}, base, .20), light = mix({1, .985, .95}, base, .04);
  Color c;
  for (int i = 0; i < 3; ++i) {
    const double middle = 2 * base[i] - (dark[i] + light[i]) / 2;  // the parabola passes through the colour at 1/2
    c[i] = std::clamp((1 - t) * (1 - t) * dark[i] + 2 * t * (1 - t) * middle + t * t * light[i], 0., 1.);
  }
  return c;
}

// ---- SVG

std::string hex(const Color& color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (double c : color) {
    const int byte = static_cast<int>(std::lround(255 * c));
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return result;
}

/// Tenths of a pixel with at most one decimal.
std::string pixels(double value) {
  const long tenths = std::lround(value * units);
  std::string text = std::to_string(std::abs(tenths) / units);
  if (tenths % units != 0) text += "." + std::to_string(std::abs(tenths) % units);
  return tenths < 0 ? "-" + text : text;
}

struct Spot {  // in SVG units
  int x = 0, y = 0;
  auto operator<=>(const Spot&) const = default;
};

Spot spot(const Projected& p) {
  return {static_cast<int>(std::lround(p.x * units)), static_cast<int>(std::lround(p.y * units))};
}

/// Path data of relative steps, the shortest form there is.
class Path {
 public:
  void move(Spot to) { step('m', to), start_ = to; }
  void line(Spot to) { step(0, to); }
  void close() { data_ += 'z', at_ = start_; }
  /// A mark that a round line cap makes a disc.
  void dot(Spot to) { move(to), data_ += "h0"; }
  const std::string& data() const { return data_; }

 private:
  void step(char command, Spot to) {
    if (command != 0) data_ += command;
    number(to.x - at_.x, command == 0);
    number(to.y - at_.y, true);
    at_ = to;
  }
  void number(int value, bool separate) {
    if (separate && value >= 0) data_ += ' ';
    data_ += std::to_string(value);
  }
  std::string data_;
  Spot at_, start_;
};

/// Outline of the union of polygons that do not overlap and all turn the same way: edges used in both directions
/// cancel.
class Outline {
 public:
  void add(const std::vector<Spot>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Spot a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (a < b) segments_.push_back({a, b, 1});
      if (b < a) segments_.push_back({b, a, -1});
    }
  }
  std::string data() {
    const std::vector<Step> edges = what_is_left();
    Path path;
    std::vector<bool> used(edges.size(), false);
    for (std::size_t first = 0; first < edges.size(); ++first) {
      if (used[first]) continue;
      std::vector<Spot> loop;
      for (std::size_t e = first;
           !used[e];) {  // as many edges leave a point as arrive there, so the walk ends where it began
        used[e] = true;
        loop.push_back(edges[e].from);
        const auto starts_before = [](const Step& edge, Spot at) { return edge.from < at; };
        e = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), edges[e].to, starts_before) -
                                     edges.begin());
        while (used[e] && e + 1 < edges.size() && edges[e + 1].from == edges[e].from) ++e;
      }
      write(path, loop);
    }
    return path.data();
  }

 private:
  struct Segment {
    Spot low, high;
    int uses = 1;  // from low to high less from high to low
  };
  struct Step {
    Spot from, to;
    auto operator<=>(const Step&) const = default;
  };

  std::vector<Step> what_is_left() {
    const auto before = [](const Segment& a, const Segment& b) {
      return a.low != b.low ? a.low < b.low : a.high < b.high;
    };
    std::sort(segments_.begin(), segments_.end(), before);
    std::vector<Step> left;
    for (std::size_t i = 0; i < segments_.size();) {
      const Segment first = segments_[i];
      int uses = 0;
      for (; i < segments_.size() && segments_[i].low == first.low && segments_[i].high == first.high; ++i)
        uses += segments_[i].uses;
      for (; uses > 0; --uses) left.push_back({first.low, first.high});
      for (; uses < 0; ++uses) left.push_back({first.high, first.low});
    }
    std::sort(left.begin(), left.end());
    return left;
  }

  /// Leaves out points that are within a tenth of a pixel of the chord.
  static void write(Path& path, const std::vector<Spot>& loop) {
    const auto off_chord = [](Spot a, Spot b, Spot p) {
      const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
      if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
      return std::abs(x * (p.y - a.y) - y * (p.x - a.x)) / length;
    };
    if (loop.size() < 3) return;
    path.move(loop[0]);
    std::size_t last = 0;
    for (std::size_t i = 2; i <= loop.size(); ++i) {
      const Spot next = loop[i % loop.size()];
      bool straight = i - last < 24;
      for (std::size_t k = last + 1; straight && k < i; ++k) straight = off_chord(loop[last], next, loop[k]) < 1;
      if (straight) continue;
      path.line(loop[i - 1]);
      last = i - 1;
    }
    path.close();
  }

  std::vector<Segment> segments_;
};

class PanelWriter {
 public:
  PanelWriter(const Panel& panel, const Frame& frame, const Camera& camera, const PictureOptions& options)
      : panel_(panel),
        camera_(camera),
        scene_(scene_of(panel, frame, camera)),
        buffer_(static_cast<int>(std::ceil(options.panel_width * supersampling)),
                static_cast<int>(std::ceil(options.panel_height * supersampling))) {
    light_from_sky(scene_, camera);
    set_tones(scene_, camera);
    for (const Vector3d& p : scene_.points) at_.push_back(camera.project(p));
    for (int f = 0; f < static_cast<int>(scene_.faces.size()); ++f) {
      if (!scene_.faces[f].solid) continue;
      triangles(scene_.faces[f],
                [&](const Projected& a, const Projected& b, const Projected& c) { buffer_.draw(a, b, c, f); });
    }
  }

  std::string write() {
    std::string svg;
    write_faces(svg);
    for (int l = 0; l < static_cast<int>(panel_.layers.size()); ++l) write_lines(svg, l);
    return svg;
  }

 private:
  template <class Use>
  void triangles(const SceneFace& face, Use use) const {
    const auto fine = [](Projected p) { return Projected{p.x * supersampling, p.y * supersampling, p.near}; };
    for_each_triangle(
        scene_, face, at_, camera_.project(face.center),
        [&](const Projected& a, const Projected& b, const Projected& c) { use(fine(a), fine(b), fine(c)); });
  }

  /// A point of a face on the paper, and its tone.
  struct Shaded {
    Spot at;
    double tone = 0;
  };

  // A face that nothing hides may be drawn after all others and in any order; so these are merged. What is hidden in
  // part is drawn before them, from far to near.
  void write_faces(std::string& svg) const {
    const std::vector<float> nearest = buffer_.nearest_around();
    std::vector<int> partial;
    std::map<std::pair<bool, int>, std::vector<int>>
        whole;  // outside or not, layer: insides first, so that outlines stay clean
    for (int f = 0; f < static_cast<int>(scene_.faces.size()); ++f) {
      const SceneFace& face = scene_.faces[f];
      if (!face.solid) continue;
      int shown = 0, beside = 0, hidden = 0;
      bool touched = false;  // by the outline of something in front, which must be drawn later
      triangles(face, [&](const Projected& a, const Projected& b, const Projected& c) {
        buffer_.scan(a, b, c, [&](std::size_t pixel, float near) {
          const bool ours = buffer_.face(pixel) == f, behind = buffer_.near(pixel) > near + surface_gap;
          ++(ours ? shown : behind ? hidden : beside);
          touched |= nearest[pixel] > near + outline_gap;
        });
      });
      if (shown > 0 && hidden == 0 && !touched && (!face.back || shown > beside)) {
        whole[{!face.back, face.layer}].push_back(f);
      } else if (shown > 0 || (beside > 0 && !face.back)) {
        partial.push_back(f);
      }
    }
    std::stable_sort(partial.begin(), partial.end(),
                     [&](int f, int g) { return scene_.faces[f].center.z() < scene_.faces[g].center.z(); });
    svg += "<g stroke-width=\"6\">\n";  // strokes of the same colour close the seams
    for (int f : partial) {
      const SceneFace& face = scene_.faces[f];
      std::vector<Spot> polygon;
      for (int c = face.begin; c < face.end; ++c) polygon.push_back(spot(at_[scene_.corners[c].point]));
      Outline outline;
      outline.add(polygon);
      write_fill(svg, face.layer, face.back, static_cast<int>(std::lround(face.tone)), outline.data());
    }
    for (const auto& [where, faces] : whole) write_terraces(svg, where.second, !where.first, faces);
    svg += "</g>\n";
  }

  /// Smooth shading by terraces: for each tone the part of the faces that is at least as bright, over the darker ones.
  /// Nothing has to fit edge to edge, so there are no seams.
  void write_terraces(std::string& svg, int layer, bool back, const std::vector<int>& faces) const {
    std::array<Outline, tones> terraces;
    for (int f : faces) {
      const SceneFace& face = scene_.faces[f];
      const Shaded center{spot(camera_.project(face.center)), face.tone};
      for (int c = face.begin; c < face.end; ++c) {
        const Shaded a = shaded(c), b = shaded(scene_.next(face, c));
        if (back) {
          add_terraces(terraces, {center, b, a});
        } else {
          add_terraces(terraces, {center, a, b});
        }
      }
    }
    std::string waiting;  // a terrace that the next one covers entirely is not written
    int tone = 0;
    for (int t = 0; t < tones; ++t) {
      const std::string data = terraces[t].data();
      if (data != waiting) write_fill(svg, layer, back, tone, waiting);
      waiting = data;
      tone = t;
    }
    write_fill(svg, layer, back, tone, waiting);
  }

  Shaded shaded(int corner) const { return {spot(at_[scene_.corners[corner].point]), scene_.corners[corner].tone}; }

  static void add_terraces(std::array<Outline, tones>& terraces, const std::array<Shaded, 3>& triangle) {
    const auto [low, high] = std::minmax({triangle[0].tone, triangle[1].tone, triangle[2].tone});
    for (int t = 0; t < tones; ++t) {
      const double level = t - .5;
      if (high <= level) break;
      std::vector<Spot> polygon;
      for (int i = 0; i < 3; ++i) {
        const Shaded &a = triangle[i], &b = triangle[(i + 1) % 3];
        if (a.tone > level) polygon.push_back(a.at);
        if ((a.tone > level) != (b.tone > level)) polygon.push_back(crossing(a, b, level));
      }
      terraces[t].add(polygon);
    }
  }

  /// Where an edge has a tone; the same point from both of its sides.
  static Spot crossing(Shaded a, Shaded b, double level) {
    if (b.at < a.at) std::swap(a, b);
    const double t = (level - a.tone) / (b.tone - a.tone);
    return {static_cast<int>(std::lround(a.at.x + t * (b.at.x - a.at.x))),
            static_cast<int>(std::lround(a.at.y + t * (b.at.y - a.at.y)))};
  }

  void write_fill(std::string& svg, int layer, bool back, int tone, const std::string& data) const {
    if (data.empty()) return;
    const Color& base = panel_.layers[layer].color;
    const Color inside = mix(base, {.45, .30, .22}, .45);  // the back of an open surface is warmer
    const std::string color = hex(ramp(back ? inside : base, tone / (tones - 1.)));
    svg += "<path fill=\"" + color + "\" stroke=\"" + color + "\" d=\"" + data + "\"/>\n";
  }

  void write_lines(std::string& svg, int layer) const {
    const PictureMesh& mesh = panel_.layers[layer];
    std::map<std::pair<int, int>, std::vector<int>> edge_faces;
    std::map<int, std::vector<int>> vertex_faces;
    for (int f = 0; f < static_cast<int>(scene_.faces.size()); ++f) {
      const SceneFace& face = scene_.faces[f];
      if (face.layer != layer) continue;
      for (int c = face.begin; c < face.end; ++c) {
        const int a = scene_.corners[c].point, b = scene_.corners[scene_.next(face, c)].point;
        edge_faces[std::minmax(a, b)].push_back(f);
        vertex_faces[a].push_back(f);
      }
    }
    const auto faces_of = [&](int a, int b) {
      const auto found = edge_faces.find(std::minmax(a, b));
      return found == edge_faces.end() ? std::vector<int>{} : found->second;
    };
    if (mesh.wireframe) {
      Path path;
      for (const auto& [edge, faces] : edge_faces) add_visible(path, edge.first, edge.second, faces);
      write_stroke(svg, ramp(mesh.color, .05), mesh.faces ? 5 : 7, .6, path.data());
    }
    const int first = scene_.first_point[layer];
    std::map<double, Path> creases;
    for (const PictureMesh::Line& line : mesh.creases) {
      add_visible(creases[line.strength], first + line.tail, first + line.head,
                  faces_of(first + line.tail, first + line.head));
    }
    for (const auto& [strength, path] : creases) {
      write_stroke(svg, mix({.95, .62, .15}, {.80, .16, .12}, strength),
                   static_cast<int>(std::lround(14 + 10 * strength)), 1, path.data());
    }
    Path dots;
    for (Index v : mesh.dots) {
      const Projected& p = at_[first + v];
      const auto near = vertex_faces.find(first + v);
      if (visible(p, near == vertex_faces.end() ? std::vector<int>{} : near->second)) dots.dot(spot(p));
    }
    write_stroke(svg, {1, 1, 1}, 66, 1, dots.data());
    write_stroke(svg, {.10, .12, .22}, 46, 1, dots.data());
  }

  bool visible(const Projected& p, const std::vector<int>& own) const {
    const auto ours = [&](int face, float near) {
      return near <= p.near + line_gap || std::find(own.begin(), own.end(), face) != own.end();
    };
    return buffer_.share_around(p.x * supersampling, p.y * supersampling, ours) > 0;
  }

  void add_visible(Path& path, int tail, int head, const std::vector<int>& own) const {
    const Projected &a = at_[tail], &b = at_[head];
    const int steps = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y))));
    const auto between = [&](double t) {
      return Projected{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.near + t * (b.near - a.near)};
    };
    for (int i = 0; i < steps;) {
      const auto shown = [&](int k) { return visible(between((k + .5) / steps), own); };
      const int begin = i;
      while (i < steps && shown(i)) ++i;
      if (i > begin) {
        path.move(spot(between(static_cast<double>(begin) / steps)));
        path.line(spot(between(static_cast<double>(i) / steps)));
      } else {
        ++i;
      }
    }
  }

  void write_stroke(std::string& svg, const Color& color, int width, double opacity, const std::string& data) const {
    if (data.empty()) return;
    svg += "<path fill=\"none\" stroke-linecap=\"round\" stroke=\"" + hex(color) + "\" stroke-width=\"" +
           std::to_string(width) + "\"";
    if (opacity < 1) svg += " stroke-opacity=\"" + pixels(opacity) + "\"";
    svg += " d=\"" + data + "\"/>\n";
  }

  // Differences in depth, in a scene of radius 1 to sqrt(3), up to which two samples are taken to be on the same
  // surface.
  static constexpr double surface_gap = .002, line_gap = .005, outline_gap = .03;

  const Panel& panel_;
  const Camera& camera_;
  Scene scene_;
  DepthBuffer buffer_;
  std::vector<Projected> at_;
};

/// A soft spot on the ground below what stands there: an ellipse with a gradient, the only thing that is not sharp.
std::string ground_shadow(const Panel& panel, const Frame& frame, const Camera& camera) {
  const double rise = camera.axes.row(2).dot(camera.up);  // sine of the elevation
  std::vector<Vector3d> points;
  for (const PictureMesh& mesh : panel.layers) {
    if (!mesh.faces) continue;
    for (Index v : mesh.face_vertices) points.push_back(frame.local(mesh.positions.row(v)));
  }
  if (points.empty() || rise < .05) return {};
  const auto height = [&](const Vector3d& p) { return p.dot(camera.up); };
  const auto by_height = [&](const Vector3d& p, const Vector3d& q) { return height(p) < height(q); };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_height);
  const double low = height(*lowest), reach = .06 * (height(*highest) - low);
  Vector3d center = Vector3d::Zero();
  double count = 0, radius = 0;
  for (const Vector3d& p : points) {
    if (height(p) <= low + reach) center += p, ++count;
  }
  center /= count;
  for (const Vector3d& p : points) {
    const Vector3d d = p - center;
    if (height(p) <= low + reach) radius = std::max(radius, (d - d.dot(camera.up) * camera.up).norm());
  }
  const Projected middle = camera.project(camera.seen(center));
  const double across = 1.55 * radius * camera.scale;
  return "<ellipse cx=\"" + pixels(middle.x) + "\" cy=\"" + pixels(middle.y) + "\" rx=\"" + pixels(across) +
         "\" ry=\"" + pixels(across * rise) + "\" fill=\"url(#shadow)\"/>\n";
}

/// Scale and shift with which everything of all panels fits, with a margin.
void fit(Camera& camera, const std::vector<Panel>& panels, const Frame& frame, const PictureOptions& options) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Panel& panel : panels) {
    for (const PictureMesh& mesh : panel.layers) {
      const auto add = [&](Index v) {
        const Projected p = camera.project(camera.seen(frame.local(mesh.positions.row(v))));
        low = low.cwiseMin(Vector2d(p.x, p.y));
        high = high.cwiseMax(Vector2d(p.x, p.y));
      };
      for (Index v : mesh.face_vertices) add(v);
      for (const PictureMesh::Line& line : mesh.creases) add(line.tail), add(line.head);
      for (Index v : mesh.dots) add(v);
    }
  }
  const Vector2d size(options.panel_width, options.panel_height);
  const double margin = .06 * size.minCoeff();
  if (!(low.x() <= high.x())) return;
  const Vector2d extent = (high - low).cwiseMax(1e-3);
  camera.scale = ((size.array() - 2 * margin) / extent.array()).minCoeff();
  camera.shift = size / 2 - camera.scale * (low + high) / 2;
}

}  // namespace

std::string svg_picture(const std::vector<Panel>& panels, const PictureOptions& options) {
  check(options);
  for (int p = 0; p < static_cast<int>(panels.size()); ++p) {
    for (int l = 0; l < static_cast<int>(panels[p].layers.size()); ++l) check(panels[p].layers[l], p, l);
  }
  const Frame frame = frame_of(panels);
  Camera camera(options);
  fit(camera, panels, frame, options);

  constexpr double border = 14, caption_height = 58;
  const double width = static_cast<double>(panels.size()) * options.panel_width + 2 * border;
  const double height = options.panel_height + caption_height + border;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + pixels(width) + " " + pixels(height) +
                    "\" width=\"" + pixels(width) + "\" height=\"" + pixels(height) +
                    "\" font-family=\"system-ui, sans-serif\" text-anchor=\"middle\">\n";
  svg += "<rect width=\"100%\" height=\"100%\" rx=\"16\" fill=\"#f4f2ed\"/>\n";
  if (options.ground_shadow) {
    svg +=
        "<radialGradient id=\"shadow\"><stop offset=\".5\" stop-color=\"#3a3f55\" stop-opacity=\".42\"/>"
        "<stop offset=\".75\" stop-color=\"#3a3f55\" stop-opacity=\".14\"/>"
        "<stop offset=\"1\" stop-color=\"#3a3f55\" stop-opacity=\"0\"/></radialGradient>\n";
  }
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    svg += "<g transform=\"translate(" + pixels(border + static_cast<double>(p) * options.panel_width) + " " +
           pixels(border) + ")\">\n";
    if (options.ground_shadow) svg += ground_shadow(panel, frame, camera);
    svg += "<g transform=\"scale(.1)\" stroke-linejoin=\"round\">\n";
    svg += PanelWriter(panel, frame, camera, options).write();
    svg += "</g>\n";
    const auto line = [&](double below, const char* style, const std::string& text) {
      if (text.empty()) return;
      svg += "<text x=\"" + pixels(options.panel_width / 2) + "\" y=\"" + pixels(options.panel_height + below) + "\" " +
             style + ">" + escaped(text) + "</text>\n";
    };
    line(22, "font-size=\"17\" font-weight=\"600\" fill=\"#2b2f38\"", panel.caption);
    line(43, "font-size=\"13\" fill=\"#6a6f7a\"", panel.note);
    svg += "</g>\n";
  }
  svg += "</svg>\n";
  return svg;
}

}  // namespace sublimit
