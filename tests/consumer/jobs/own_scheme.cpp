// A scheme of one's own, with its report.
#include <sublimit/certificates/numbers/algebraic.h>
#include <sublimit/sublimit.h>

using namespace sublimit;

template <class T>
Scheme<T> mine() {
  const auto vertex = [](const Ring<T>& v) { return (v.center() + v.neighbor_mean() + 2 * v.face_point_mean()) / 4; };
  const auto edge = [](const EdgeSite<T>& e) { return (e.left_face().point() + e.right_face().point()) / 2; };
  const auto face = [](const FaceSite<T>& f) { return f.centroid(); };
  return {.name = "mine",
          .source = "here",
          .steps = {Step<T>{Split::pqq, {.vertex = vertex, .edge = edge, .face = face}}},
          .creases = cubic_bspline_creases<T>()};
}

int main() { analyze(mine<double>(), mine<Algebraic>(), {.valences = {3, 4, 5}}).save_html("mine.html"); }
