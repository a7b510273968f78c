// SPDX-License-Identifier: Apache-2.0
#pragma once
// Artificial reports in the format of stencils/report_format.md, of realistic shape and size, for tests of
// pages.
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace sublimit::testing {

using SampleJson = nlohmann::ordered_json;

inline SampleJson sample_verdict(const std::string& property, const std::string& verdict) {
  return {{"property", property},
          {"says", "C^1 at the extraordinary point"},
          {"verdict", verdict},
          {"theorem", "Reif 1995, theorem 2.1: a regular, injective characteristic map of a simple pair lambda"},
          {"hypotheses",
           {{{"says", "eigenvalue 1 is simple"}, {"holds", true}, {"by", "exact"}, {"value", "multiplicity 1"}},
            {{"says", "mu < lambda"}, {"holds", nullptr}, {"by", "floating"}, {"value", "0.34 < 0.55"}}}},
          {"because", "the pair of blocks +-1 leads, and its map is regular and injective"},
          {"witness", {{"kind", "bernstein"}, {"coefficients", {"1/2", "3/4"}}}}};
}

/// A plane sector grid of `rings` rings around a centre: labels, points, quads.
struct SampleNet {
  std::vector<std::array<int, 3>> labels;
  std::vector<std::complex<double>> points;
  std::vector<std::vector<int>> faces;
};
inline SampleNet sample_net(int n, int rings, int fine, double power) {
  SampleNet net;
  std::map<std::array<int, 3>, int> index;
  const auto id = [&](int s, int x, int y) {
    if (x == 0) s = (s + 1) % n, x = y, y = 0;
    if (x == 0) s = 0;
    const auto [found, fresh] = index.try_emplace({s, x, y}, static_cast<int>(net.points.size()));
    if (fresh) {
      const double angle = (s + std::atan2(y, x) / (std::numbers::pi / 2)) * 2 * std::numbers::pi / n;
      net.labels.push_back({s, x, y});
      net.points.push_back(std::polar(std::pow(std::hypot(x, y) / fine, power), angle));
    }
    return found->second;
  };
  id(0, 0, 0);
  for (int s = 0; s < n; ++s)
    for (int x = 0; x < rings * fine; ++x)
      for (int y = 0; y < rings * fine; ++y)
        net.faces.push_back({id(s, x, y), id(s, x + 1, y), id(s, x + 1, y + 1), id(s, x, y + 1)});
  return net;
}

inline SampleJson sample_surface(int n, double power) {
  const SampleNet net = sample_net(n, 2, 5, power);
  const auto height = [&](double x, double y) {
    return .12 * (x * x + y * y) + .22 * (x * x - y * y) + .06 * x * x * x;
  };
  SampleJson positions = SampleJson::array(), normals = positions, curvature = positions;
  for (const std::complex<double>& p : net.points) {
    const double x = p.real(), y = p.imag(), d = 1e-3;
    const double hx = (height(x + d, y) - height(x - d, y)) / (2 * d),
                 hy = (height(x, y + d) - height(x, y - d)) / (2 * d);
    const double xx = .68 + .36 * x, yy = -.2, w = 1 + hx * hx + hy * hy;
    positions.push_back({x, y, height(x, y)});
    normals.push_back({-hx, -hy, 1.});
    if (positions.size() == 1) {
      curvature.push_back(nullptr);
    } else {
      curvature.push_back({(xx + yy) / 2, xx * yy / (w * w) + .4 * x});
    }
  }
  return {{"positions", positions}, {"faces", net.faces}, {"normals", normals}, {"curvature", curvature}};
}

inline SampleJson sample_neighborhood(const std::string& kind, int n) {
  const double c = std::cos(2 * std::numbers::pi / n);
  const double lambda = (5 + c + std::sqrt((c + 1) * (c + 9))) / 16,
               mu = n == 4 ? .25 : lambda * lambda * (.8 + .06 * n);
  SampleJson spectrum = SampleJson::array();
  spectrum.push_back({{"block", 0},
                      {"value", {1., 0.}},
                      {"modulus", 1.},
                      {"enclosure", nullptr},
                      {"exact", "1"},
                      {"multiplicity", 1},
                      {"geometric", 1}});
  for (int k = 0; k < n; ++k) {
    const double ck = std::cos(2 * std::numbers::pi * k / n), root = std::sqrt((ck + 1) * (ck + 9));
    for (double v : {(5 + ck + root) / 16, (5 + ck - root) / 16})
      spectrum.push_back({{"block", k},
                          {"value", {k == 0 ? v / 2 : v, 0.}},
                          {"modulus", k == 0 ? v / 2 : v},
                          {"enclosure", "[0.54998834973215629 +/- 3.1e-30]"},
                          {"exact", k == 1 ? SampleJson("(11+sqrt(5))/24") : SampleJson()},
                          {"multiplicity", 2},
                          {"geometric", k == 2 ? 1 : 2}});
  }
  SampleJson position = SampleJson::array(), t1 = position, t2 = position;
  const double total = n * (n + 5);
  position.push_back({{"label", {0, 0, 0}},
                      {"weight", n * n / total},
                      {"exact", std::to_string(n * n) + "/" + std::to_string(n * (n + 5))}});
  for (int s = 0; s < n; ++s) {
    const double a = 2 * std::numbers::pi * s / n;
    position.push_back({{"label", {s, 1, 0}}, {"weight", 4 / total}, {"exact", nullptr}});
    position.push_back({{"label", {s, 1, 1}}, {"weight", 1 / total}, {"exact", "1/" + std::to_string(n * (n + 5))}});
    t1.push_back({{"label", {s, 1, 0}}, {"weight", std::cos(a)}, {"exact", nullptr}});
    t2.push_back({{"label", {s, 1, 0}}, {"weight", std::sin(a)}, {"exact", nullptr}});
  }
  const double power = -std::log2(lambda);
  const SampleNet net = sample_net(n, 3, 1, power), fine = sample_net(n, 3, 4, power);
  SampleJson points = SampleJson::array(), bowl = points, saddle = points, turned = points, lines = points;
  for (std::size_t i = 0; i < net.points.size(); ++i) {
    const std::complex<double> p = net.points[i];
    points.push_back({{"label", net.labels[i]}, {"at", {p.real(), p.imag()}}});
    const double r = std::pow(std::abs(p), 2.1), t = std::arg(p);
    bowl.push_back(r), saddle.push_back(r * std::cos(2 * t)), turned.push_back(r * std::sin(2 * t));
  }
  for (int s = 0; s < n; ++s)
    for (int i = 0; i <= 12; i += 2)
      for (int across = 0; across < 2; ++across) {
        SampleJson polyline = SampleJson::array();
        for (int j = 0; j <= 12; ++j) {
          const int x = across ? j : i, y = across ? i : j;
          const double angle =
              (s + (x + y == 0 ? 0 : std::atan2(y, x) / (std::numbers::pi / 2))) * 2 * std::numbers::pi / n;
          const std::complex<double> p = std::polar(std::pow(std::hypot(x, y) / 4, power), angle);
          polyline.push_back({p.real(), p.imag()});
        }
        lines.push_back(polyline);
      }
  const bool interior = kind == "vertex" || kind == "face";
  SampleJson verdicts = {sample_verdict(interior ? "c1" : "tangent-plane", n < 8 ? "proved" : "evidence-for"),
                         sample_verdict("curvature", "disproved")};
  verdicts[1]["says"] = "curvature is bounded";
  verdicts[1]["curvature"] = n == 3 ? "flat" : n == 4 ? "bounded" : "divergent";
  if (interior)
    verdicts.push_back(sample_verdict("curvature-integrability", "borderline")),
        verdicts.back()["p"] = n == 4 ? SampleJson() : SampleJson(10.2);
  if (interior) verdicts.push_back(sample_verdict("shapes", "unknown")), verdicts.back()["shapes"] = "all";
  const auto function = [&](int block, const SampleJson& heights) {
    return SampleJson{{"block", block}, {"value", {mu, 0.}}, {"heights", heights}};
  };
  return {{"kind", kind},
          {"n", n},
          {"points", net.points.size()},
          {"labels", net.labels},
          {"spectrum", spectrum},
          {"lambda", lambda},
          {"mu", mu},
          {"ratio", mu / (lambda * lambda)},
          {"mu_blocks", {2, n - 2}},
          {"masks", {{"position", position}, {"tangent1", t1}, {"tangent2", t2}, {"second", nullptr}}},
          {"characteristic_map",
           {{"net", points},
            {"faces", net.faces},
            {"lines", lines},
            {"jacobian", {{"sign", 1}, {"least", .12}, {"greatest", 3.4}, {"by", "enclosure"}}}}},
          {"eigenfunctions", {function(0, bowl), function(2, saddle), function(n - 2, turned)}},
          {"surface", interior ? sample_surface(n, power) : SampleJson()},
          {"normals", {{"steps", {1, 2, 3, 4, 5}}, {"spread_degrees", {20., 9., 4.1, nullptr, .9}}}},
          {"verdicts", verdicts}};
}

/// Returns a regular part: bicubic B-splines, quartic box splines or the cubic curve, by the word for the grid.
inline SampleJson sample_regular(const std::string& grid) {
  const int row[5] = {1, 4, 6, 4, 1};
  const auto cubic = [](double t) {
    t = std::abs(t);
    return t >= 2 ? 0. : t >= 1 ? (2 - t) * (2 - t) * (2 - t) / 6 : 2. / 3 - t * t + t * t * t / 2;
  };
  SampleJson mask = SampleJson::array(), x = mask, y = mask, values = mask, outline = mask, slope = mask;
  const bool line = grid == "line", triangles = grid == "triangular";
  std::map<std::pair<int, int>, int> box;
  if (triangles)
    for (int bits = 0; bits < 64; ++bits) {
      const auto on = [&](int b) { return bits >> b & 1; };
      ++box[{on(0) + on(1) + on(4) + on(5) - 2, on(2) + on(3) + on(4) + on(5) - 2}];
    }
  else
    for (int i = -2; i <= 2; ++i)
      for (int j = line ? 0 : -2; j <= (line ? 0 : 2); ++j) box[{i, j}] = row[i + 2] * (line ? 1 : row[j + 2]);
  const int bottom = line ? 8 : triangles ? 16 : 64;
  for (const auto& [where, top] : box)
    mask.push_back({{"at", {where.first, where.second}},
                    {"weight", top / double(bottom) / (triangles ? 1 : 1)},
                    {"exact", std::to_string(top) + "/" + std::to_string(bottom)}});
  for (int i = -20; i <= 20; ++i) x.push_back(i / 10.);
  for (int j = line ? 0 : -20; j <= (line ? 0 : 20); ++j) {
    y.push_back(j / 10.);
    SampleJson one = SampleJson::array();
    for (int i = -20; i <= 20; ++i) one.push_back(cubic(i / 10.) * (line ? 1 : cubic(j / 10.)));
    values.push_back(one);
  }
  if (triangles)
    outline = {{-2, -2}, {0, -2}, {2, 0}, {2, 2}, {0, 2}, {-2, 0}};
  else
    outline = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  return {
      {"dilation", 2},
      {"mask", mask},
      {"unit", 1},
      {"grid", grid},
      {"support", {{"text", "two rings of faces"}, {"outline", outline}}},
      {"smoothness", {{"continuity", 2}, {"exponent", {3., triangles ? 3. : 3.05}}, {"notes", "factors (1+z)^2"}}},
      {"norms", {{{"order", 1}, {"steps", 2}, {"norm", .5}, {"enclosure", {"0.5", "0.5"}}}}},
      {"joint_spectral_radius", {{"low", .125}, {"high", .125}, {"products", 4}}},
      {"degrees", {{"generates", 3}, {"reproduces", 1}, {"approximation_order", 2}}},
      {"operations",
       {{"per_new_point", 5.5}, {"by_kind", {{{"kind", "vertex"}, {"points", 9}}, {{"kind", "edge"}, {"points", 6}}}}}},
      {"basis", {{"x", x}, {"y", y}, {"values", values}}},
      {"criteria",
       {{"efficiency", "5.5 points per new point"},
        {"support", "two rings"},
        {"locality", "1-ring"},
        {"simplicity", "3 masks"},
        {"continuity", "C^2"}}},
      {"verdicts", {sample_verdict("regular-smoothness", "proved")}}};
}

inline SampleJson sample_scheme(const std::string& name, const std::string& grid, int first = 3, int last = 12) {
  SampleJson neighborhoods = SampleJson::array();
  if (grid != "line") {
    for (int n = first; n <= last; ++n) neighborhoods.push_back(sample_neighborhood("vertex", n));
    for (const char* kind : {"border", "crease", "corner"})
      for (int n = 1; n <= 3; ++n) neighborhoods.push_back(sample_neighborhood(kind, n + 2));
    neighborhoods.push_back(sample_neighborhood("dart", 5));
  }
  return {
      {"name", name},
      {"kind", grid == "line" ? "curve" : "surface"},
      {"options", {{"tension", "1"}}},
      {"source", "Catmull, Clark 1978, \"Recursively generated B-spline surfaces\""},
      {"mesh", "any"},
      {"split", {"pqq"}},
      {"interpolates", false},
      {"claims",
       {{{"claim", "regular"}, {"claimed", 2}, {"found", 2}, {"verdict", "proved"}, {"because", "knots of B-splines"}},
        {{"claim", "extraordinary"},
         {"claimed", 1},
         {"found", nullptr},
         {"verdict", "evidence-for"},
         {"because", nullptr}}}},
      {"regular", sample_regular(grid)},
      {"neighborhoods", neighborhoods},
      {"all_valences", grid == "line" ? SampleJson() : sample_verdict("c1-all-valences", "proved")}};
}

inline SampleJson sample_report(const std::string& kind) {
  return {{"format", "sublimit-report"}, {"version", 1}, {"program", "0.1.0"}, {"kind", kind}};
}

inline SampleJson sample_schemes(int first = 3, int last = 12) {
  SampleJson report = sample_report("schemes");
  report["schemes"] = {sample_scheme("catmull-clark", "square", first, last),
                       sample_scheme("loop", "triangular", first, last), sample_scheme("four-point", "line")};
  for (const char* name : {"catmull-clark", "loop", "four-point"})
    report["summary"].push_back({{"scheme", name},
                                 {"type", "approximating"},
                                 {"mesh", "any"},
                                 {"regular", "C^2"},
                                 {"extraordinary", name[0] == 'f' ? SampleJson() : SampleJson("C^1")},
                                 {"regular_verdict", "proved"},
                                 {"extraordinary_verdict", "evidence-for"},
                                 {"valences", "3-12"},
                                 {"notes", "curvature diverges for valence 5 and more, mu > lambda^2"}});
  return report;
}

inline SampleJson sample_sweep() {
  SampleJson report = sample_report("sweep");
  SampleJson values = SampleJson::array(), low = values, high = values;
  for (int i = 0; i <= 40; ++i) {
    values.push_back(i / 10.);
    low.push_back(i == 20 || i > 32 ? SampleJson() : SampleJson(2 - std::abs(i - 10) / 15.));
    high.push_back(2.1 - std::abs(i - 10) / 18.);
  }
  report["schemes"] = {sample_scheme("four-point", "line")};
  report["sweep"] = {
      {"option", "tension"},
      {"values", values},
      {"series",
       {{{"name", "exponent, lower bound"}, {"values", low}}, {{"name", "exponent, upper bound"}, {"values", high}}}},
      {"findings", {"C^1 at least for 0 < tension < 2.4721"}}};
  return report;
}

inline SampleJson sample_curve() {
  SampleJson report = sample_report("curve");
  report["curve"] = {{"degree", 3},
                     {"pieces", {{{0, 0}, {1, 2}, {3, 2}, {4, 0}}, {{4, 0}, {5, -2}, {7, -1}, {7, 1}}}},
                     {"knots",
                      {{{"at", 1.},
                        {"c", 0},
                        {"g", 1},
                        {"tangent_ratio", .5},
                        {"verdict", "proved"},
                        {"because", "tangents agree in direction, ratio 1/2 > 0"}},
                       {{"at", 2.},
                        {"c", -1},
                        {"g", -1},
                        {"tangent_ratio", nullptr},
                        {"verdict", "disproved"},
                        {"because", "a gap"}}}}};
  return report;
}

inline SampleJson sample_mesh(const std::string& file = "car.obj") {
  SampleJson report = sample_report("mesh");
  SampleJson surface = sample_surface(5, .86);
  report["mesh"] = {
      {"file", file},
      {"scheme", "catmull-clark"},
      {"counts", {{"vertices", 812}, {"faces", 790}, {"edges", 1600}}},
      {"box", {{-1., -1., 0.}, {1., 1., .5}}},
      {"inventory",
       {{{"kind", "extraordinary vertex"},
         {"n", 5},
         {"count", 12},
         {"examples", {3, 17}},
         {"tangent_plane", "yes"},
         {"curvature", "divergent"},
         {"ratio", 1.12}},
        {{"kind", "corner"},
         {"n", 3},
         {"count", 1},
         {"examples", {9}},
         {"tangent_plane", "no"},
         {"curvature", nullptr},
         {"ratio", nullptr}}}},
      {"seams",
       {{"tolerance", {{"g0", 1e-9}, {"g1_degrees", .1}, {"g2", nullptr}}},
        {"inside", {{"g0", 1e-15}, {"g1_degrees", 3e-6}, {"g2", .5}}},
        {"edges", 1234},
        {"across_creases", {{"g0", 0.}, {"g1_degrees", 47.}, {"g2", nullptr}}},
        {"within_tolerance", false},
        {"beyond",
         {{{"edge", {3, 4}}, {"what", "g1"}, {"value", .4}, {"at", {.1, .2, .3}}},
          {{"edge", {5, 4}}, {"what", "g1"}, {"value", 3.}, {"at", {.1, .2, .3}}}}}}},
      {"curvature",
       {{"gauss", {{"min", -2.}, {"max", 3.}, {"mean", .1}, {"quantiles", {-1., 0., 1.}}}},
        {"mean", {{"min", -2.}, {"max", 3.}, {"mean", .1}, {"quantiles", {-1., 0., 1.}}}},
        {"unbounded_at", 12}}},
      {"surface", surface},
      {"worst",
       {{{"what", "Gauss curvature"}, {"value", 3.}, {"face", 7}, {"uv", {.5, .25}}, {"at", surface["positions"][20]}},
        {{"what", "G1 across a seam"},
         {"value", .4},
         {"face", 8},
         {"uv", {0., .5}},
         {"at", surface["positions"][90]}}}},
      {"warnings",
       {{{"severity", "warning"},
         {"says", "the crease ends in a dart"},
         {"where", "vertex 17 (1-based 18)"},
         {"at", {0., 0., 0.}},
         {"advice", "carry it on to a corner"}}}}};
  return report;
}

}  // namespace sublimit::testing
