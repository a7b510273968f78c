// SPDX-License-Identifier: Apache-2.0
// Masks written in Python: each is asked once for a type of neighbourhood and of numbers, and its answer kept, so a
// large mesh takes no longer than with a scheme of ours.
#include "own_schemes.h"

#include <pybind11/stl.h>
#include <tbb/task_arena.h>

#include <map>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "module.h"
#include "own_stencils.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/scheme/cubic_bspline_creases.h"
#include "sublimit/scheme/detail/check_scheme.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit::python {
namespace {

/// Answers by mask and type of site. It refers to nothing of Python, so the scheme that keeps it is no cycle.
template <class T>
class KnownStencils {
 public:
  /// make() calls Python, one at a time: others wait here, without the GIL that it needs. What Python does is its own,
  /// so the thread takes up no work of ours meanwhile, which might wait here too.
  template <class Make>
  Stencil<T> find(std::pair<std::string, std::vector<int>> type, const Make& make) {
    std::unique_lock lock(calling_, std::try_to_lock);
    if (!lock) {
      std::optional<py::gil_scoped_release> others_go_on;
      if (PyGILState_Check()) others_go_on.emplace();
      lock.lock();
    }
    const auto known = stencils_.find(type);
    if (known != stencils_.end()) return known->second;
    Stencil<T> made = tbb::this_task_arena::isolate(make);
    return stencils_.emplace(std::move(type), std::move(made)).first->second;
  }

 private:
  std::recursive_mutex calling_;  // masks ask for points of faces, which are masks
  std::map<std::pair<std::string, std::vector<int>>, Stencil<T>> stencils_;
};
struct KnownMasks {
  std::shared_ptr<KnownStencils<double>> floats = std::make_shared<KnownStencils<double>>();
  std::shared_ptr<KnownStencils<Algebraic>> exact = std::make_shared<KnownStencils<Algebraic>>();
};

/// An object of Python for threads that have no GIL.
std::shared_ptr<const py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* last) {
            if (!Py_IsInitialized()) return;
            const py::gil_scoped_acquire gil;
            delete last;
          }};
}

// Types of sites, and how many slots they have.
struct SiteType {
  std::vector<int> key;
  Index slots = 0;
};
template <class T>
SiteType type_of(const FaceSite<T>& f) {
  return {{f.size()}, f.size()};
}
template <class T>
SiteType type_of(const EdgeSite<T>& e) {
  const int left = e.left_face().size(), right = e.right_face().size();
  return {{left, right}, left + right - 2};
}
/// Valence, and where in its row of faces an open ring begins.
template <class T>
std::vector<int> shape_of(const Ring<T>& ring) {
  int start = -1;
  if (!ring.is_closed())
    for (start = 0; ring.has_neighbor(-start - 1);) ++start;
  return {ring.valence(), start};
}
template <class T>
SiteType type_of(const Ring<T>& v) {
  SiteType type{{}, 1};
  for (int i = 0; i < v.valence(); ++i) {
    type.key.push_back(v.face(i).size());
    type.slots += type.key.back() - 2;
  }
  return type;
}
template <class T>
SiteType type_of(const WideEdgeSite<T>& e) {
  const std::vector<int> tail = shape_of(e.tail_ring()), head = shape_of(e.head_ring());
  const int size = e.tail_ring().face(tail[1] < 0 ? 0 : -tail[1]).size();
  return {{size, tail[0], tail[1], head[0], head[1]}, e.num_slots()};
}
template <class T>
SiteType type_of(const WideFaceSite<T>& f) {
  SiteType type{{}, f.num_slots() + 2 * f.size()};
  for (int i = 0; i < f.size(); ++i)
    for (const int part : shape_of(f.ring(i))) type.key.push_back(part);
  return type;
}
template <class T>
SiteType type_of(const CreaseSite<T>&) {
  return {{}, 3};
}
template <class T>
SiteType type_of(const CreaseEdgeSite<T>& e) {  // virtual points are sums of two
  return {{e.before().terms().size() == 1, e.after().terms().size() == 1}, 4};
}

/// The masks of a scheme in one type of numbers.
template <class T>
class OwnMasks {
 public:
  OwnMasks(std::shared_ptr<const py::object> object, std::shared_ptr<KnownStencils<T>> known, std::string name,
           int period)
      : object_(std::move(object)), known_(std::move(known)), name_(std::move(name)), period_(period) {}

  bool has(const char* method) const { return py::hasattr(*object_, method); }

  /// The mask of this name; none if the object has none.
  template <template <class> class Site>
  Mask<T, Site<T>> mask(const char* method) const {
    if (!has(method)) return {};
    return [own = *this, method](const Site<T>& site) { return own.stencil(method, site); };
  }

 private:
  /// Of a face, seen from any corner on: its weights belong to places in the face.
  Stencil<T> stencil(const char* method, const FaceSite<T>& face) const {
    static const Masks<T> none = {};
    std::vector<Index> slots(face.size());
    std::iota(slots.begin(), slots.end(), 0);
    const Stencil<T> by_corner = answer(method, FaceSite<T>(none, face.level(), std::move(slots)));
    Stencil<T> sum;
    for (const auto& [corner, weight] : by_corner.terms()) sum += weight * face.corner(corner);
    return sum;
  }
  template <class Site>
  Stencil<T> stencil(const char* method, const Site& site) const {
    return answer(method, site);
  }

  template <template <class> class Site>
  Stencil<T> answer(const char* method, const Site<T>& site) const {
    SiteType type = type_of(site);
    const int level = site.level() % period_;
    type.key.push_back(level);
    return known_->find({method, std::move(type.key)}, [&] {
      const py::gil_scoped_acquire gil;
      const auto call = std::make_shared<MaskCall>(MaskCall{level});
      const py::object made = object_->attr(method)(Seen<Site>(site, call));
      call->over = true;
      return checked(method, made, type.slots);
    });
  }

  Stencil<T> checked(const char* method, const py::object& made, Index slots) const {
    const std::string mask = name_ + "." + method;
    if (!py::isinstance<AnyStencil>(made))
      throw py::type_error(mask + " returns a " + py::str(py::type::of(made).attr("__name__")).cast<std::string>() +
                           "; a mask returns a stencil, a sum of points of its site");
    const auto& any = made.cast<const AnyStencil&>();
    const auto* stencil = std::get_if<Stencil<T>>(&any.sum);
    if (!stencil) throw InvalidParameter(mask + " returns points of another site, kept from another call");
    check_mask(name_, method, *stencil, slots);
    return *stencil;
  }

  std::shared_ptr<const py::object> object_;
  std::shared_ptr<KnownStencils<T>> known_;
  std::string name_;
  int period_;
};

Split split_of(const std::string& word) {
  std::string all;
  for (const Split split :
       {Split::pqq, Split::ptq, Split::dqq, Split::mid_edge, Split::sqrt3, Split::dual, Split::quads, Split::keep}) {
    if (word == name(split)) return split;
    all += (all.empty() ? "" : ", ") + std::string(name(split));
  }
  throw InvalidOption("split '" + word + "' is none of " + all);
}

Sharpening sharpening_of(const std::string& word) {
  if (word == "boundary") return Sharpening::boundary;
  if (word == "sharp") return Sharpening::sharp;
  if (word == "semi-sharp") return Sharpening::semi_sharp;
  throw InvalidOption("sharpening '" + word + "' is none of boundary, sharp, semi-sharp");
}

/// One split of a level, and the object that has its masks.
struct OwnStep {
  std::shared_ptr<const py::object> object;
  KnownMasks known;
  Split split;
  bool wide_borders;

  OwnStep(py::object masks, KnownMasks own_known, const std::string& own_split, bool wide)
      : object(shared(std::move(masks))), known(std::move(own_known)), split(split_of(own_split)), wide_borders(wide) {}

  bool has(const char* method) const { return py::hasattr(*object, method); }
  bool is_primal() const { return sublimit::is_primal(split) || split == Split::keep; }

  template <class T>
  Step<T> in(const std::string& name, int period) const {
    std::shared_ptr<KnownStencils<T>> answers;
    if constexpr (std::is_same_v<T, double>)
      answers = known.floats;
    else
      answers = known.exact;
    const OwnMasks<T> own(object, std::move(answers), name, period);
    Step<T> step{.split = split,
                 .masks = {.vertex = own.template mask<Ring>("vertex"),
                           .edge = own.template mask<EdgeSite>("edge"),
                           .face = own.template mask<FaceSite>("face"),
                           .corner = own.template mask<FaceSite>("corner"),
                           .wide_edge = own.template mask<WideEdgeSite>("wide_edge"),
                           .wide_face = own.template mask<WideFaceSite>("wide_face"),
                           .wide_borders = wide_borders},
                 .creases = {.vertex = own.template mask<CreaseSite>("crease_vertex"),
                             .edge = own.template mask<CreaseEdgeSite>("crease_edge")}};
    const CreaseMasks<T> usual = cubic_bspline_creases<T>();
    if (is_primal() && !step.creases.vertex) step.creases.vertex = usual.vertex;
    if (is_primal() && !step.creases.edge) step.creases.edge = usual.edge;
    return step;
  }
};

/// @param corners  as of Scheme, with `preparation`
/// @param claims   as of `set_claim`
OwnScheme own_scheme(const std::vector<OwnStep>& steps, const std::string& name, const std::string& source,
                     const std::string& sharpening, int period, int corners, const std::vector<OwnStep>& preparation,
                     const std::vector<std::string>& claims) {
  if (name.empty() || find_scheme(name))
    throw InvalidOption("the name '" + name + "' is " + (name.empty() ? "empty" : "one of sublimit's schemes") +
                        "; give yours one of its own (`name`)");
  check_shape(name, steps.size(), preparation.size(), period, corners);
  Claims claimed;
  claimed.generates = claimed.reproduces = 0;  // nothing, unless it is said
  for (const std::string& claim : claims) report::set_claim(claimed, claim);
  const auto in_numbers = [&]<class T>(Scheme<T> scheme) {
    scheme.name = name;
    scheme.source = source;
    scheme.claims = claimed;
    scheme.period = period;
    scheme.sharpening = sharpening_of(sharpening);
    scheme.corners = corners;
    for (const OwnStep& step : steps) scheme.steps.push_back(step.template in<T>(name, period));
    for (const OwnStep& step : preparation) scheme.preparation.push_back(step.template in<T>(name, period));
    scheme.creases = scheme.steps[0].creases;
    return std::make_shared<const Scheme<T>>(check_scheme(scheme));
  };
  return {in_numbers(Scheme<double>{}), in_numbers(Scheme<Algebraic>{})};
}

}  // namespace

void add_own_schemes(py::module_& m) {
  py::class_<KnownMasks>(m, "KnownMasks").def(py::init<>());
  py::class_<OwnStep>(m, "OwnStep")
      .def(py::init<py::object, KnownMasks, const std::string&, bool>(), py::arg("masks"), py::arg("known"),
           py::arg("split"), py::arg("wide_borders"));
  py::class_<OwnScheme>(m, "OwnScheme")
      .def(py::init(&own_scheme), py::arg("steps"), py::arg("name"), py::arg("source"), py::arg("sharpening"),
           py::arg("period"), py::arg("corners"), py::arg("preparation"), py::arg("claims"));
}

}  // namespace sublimit::python
