// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/spectra.h"

#include "sublimit/certificates/spectral_verdicts.h"
#include "sublimit/limit/local_modes.h"
#include "sublimit/report/analysis/modes_json.h"
#include "sublimit/report/analysis/neighborhood.h"

namespace sublimit::report {
namespace {

using Answer = Verdict::Answer;

/// Rings of points whose modes are looked at: those that lead are within two.
constexpr int rings = 2;

template <class T>
LocalType centre(const Scheme<T>& scheme, int n) {
  return {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n};
}

std::string list(const std::vector<int>& numbers) {
  std::string text;
  for (const int n : numbers) text += (text.empty() ? "" : ", ") + std::to_string(n);
  return text;
}

bool leaves_it_to_the_map(const Verdict& v) {
  for (const Hypothesis& h : v.hypotheses)
    if (h.holds != true) return false;
  return v.answer == Answer::unknown;
}

/// The map where the spectrum is as it should be: proved, else sampled.
Answer map_answer(const ReportedScheme& scheme, std::optional<SharedAnalysis>& shared, int n) {
  if (!shared) shared = shared_analysis(scheme);
  if (shared->prover) {
    const Answer answer = shared->prover->certify(n).verdict.answer;
    if (answer == Answer::proved || answer == Answer::disproved) return answer;
  }
  const std::optional<LocalModes> modes = local_modes(scheme.scheme, centre(scheme.scheme, n));
  const Json map = modes ? characteristic_map_json(shared->types, *modes) : Json();
  return map.is_object() && map["jacobian"]["sign"] == 1 ? Answer::evidence_for : Answer::evidence_against;
}

}  // namespace

Finding is_c1(const ReportedScheme& scheme, const std::vector<int>& valences) {
  std::optional<SharedAnalysis> shared;
  std::vector<int> proved, evidence, against, jordan;
  std::string because;
  // Every extraordinary point lies among regular ones: where these fail, all do.
  const int regular = scheme.exact.face_size() == 3 ? 6 : 4;
  const Verdict usual = spectral_c1(exact_analysis(scheme.exact, centre(scheme.exact, regular), rings).value());
  if (usual.answer == Answer::disproved)
    return {Fate::refuted,
            "exact spectrum of the local matrix of a regular centre, and every other one lies among regular ones: " +
                usual.because,
            {{"not C^1", valences}}};
  for (const int n : valences) {
    const ExactAnalysis analysis = exact_analysis(scheme.exact, centre(scheme.exact, n), rings).value();
    const Verdict v = spectral_c1(analysis);
    const Answer answer = leaves_it_to_the_map(v) ? map_answer(scheme, shared, n) : v.answer;
    (answer == Answer::proved                                            ? proved
     : answer == Answer::evidence_for                                    ? evidence
     : answer == Answer::disproved || answer == Answer::evidence_against ? against
                                                                         : jordan)
        .push_back(n);
    if (because.empty() && answer != Answer::proved && answer != Answer::evidence_for)
      because = " (" + std::to_string(n) + ": " + v.because + ")";
  }
  Finding f;
  const bool some = !proved.empty() || !evidence.empty();
  f.fate = jordan.empty() && !(some && !against.empty()) ? fate(some) : Fate::depends;
  f.computed = "exact spectra of the local matrices";
  if (!proved.empty()) f.computed += ", and proofs that the characteristic maps are regular and injective";
  if (!evidence.empty()) f.computed += ", and characteristic maps, sampled";
  f.computed += because;
  const auto add = [&](const char* name, const std::vector<int>& numbers) {
    if (!numbers.empty()) f.numbers[name] = numbers;
  };
  add("C^1 at valences", proved);
  add("C^1 by samples of the map", evidence);
  add("not C^1", against);
  add("not decided by the criterion", jordan);
  return f;
}

Finding has_border_planes(const Scheme<Algebraic>& scheme, const std::vector<int>& faces) {
  std::vector<bool> is_so;
  std::vector<int> yes, slow, no, open;
  for (const int m : faces) {
    const LocalType type{.kind = Centre::Kind::vertex, .faces = m, .open = true};
    const Answer answer = tangent_plane(exact_analysis(scheme, type, -1).value()).answer;
    is_so.push_back(answer != Answer::disproved);
    (answer == Answer::disproved      ? no
     : answer == Answer::evidence_for ? yes
     : answer == Answer::borderline   ? slow
                                      : open)
        .push_back(m);
  }
  Finding f{fate(is_so), "exact spectra of the local matrices of border vertices with " + list(faces) + " faces"};
  for (const auto& [name, numbers] : {std::pair{"faces with a tangent plane", &yes},
                                      {"that is reached slowly", &slow},
                                      {"without one", &no},
                                      {"not decided", &open}})
    if (!numbers->empty()) f.numbers[name] = *numbers;
  return f;
}

Finding is_affine(const Scheme<Algebraic>& scheme, const std::vector<int>& valences) {
  std::vector<bool> is_so;
  Finding f;
  for (const int n : valences) {
    const LocalPatch<Algebraic> patch = local_patch(scheme, centre(scheme, n)).value();
    Algebraic sum;
    for (Eigen::Index j = 0; j < patch.A.cols(); ++j) sum += patch.A(0, j);
    is_so.push_back(sum.is_one());
    f.numbers["sum of weights, n = " + std::to_string(n)] = sum.text();
  }
  f.fate = fate(is_so);
  f.computed = "the weights of a new point, summed exactly";
  return f;
}

Finding keeps_centroids(const Scheme<Algebraic>& scheme, const std::vector<int>& corners) {
  std::vector<bool> is_so;
  for (const int n : corners) {
    const LocalPatch<Algebraic> patch = local_patch(scheme, centre(scheme, n), 0).value();
    bool kept = patch.A.rows() == n;
    for (Eigen::Index j = 0; kept && j < patch.A.cols(); ++j) {
      Algebraic sum;
      for (Eigen::Index i = 0; i < patch.A.rows(); ++i) sum += patch.A(i, j);
      kept = sum.is_one();
    }
    is_so.push_back(kept);
  }
  return {fate(is_so), "columns of the exact matrices of faces of " + list(corners) +
                           " corners sum to 1, so that means are kept, in the limit too"};
}

Finding same_rule(const Scheme<Algebraic>& a, const Scheme<Algebraic>& b, const std::vector<int>& valences,
                  int rings_of_points) {
  std::vector<bool> is_so;
  Finding f;
  std::vector<int> same, other;
  for (const int n : valences) {
    const auto A = local_patch(a, centre(a, n), rings_of_points).value().A;
    const auto B = local_patch(b, centre(b, n), rings_of_points).value().A;
    bool equal = A.rows() == B.rows();
    for (Eigen::Index i = 0; equal && i < A.rows(); ++i)
      for (Eigen::Index j = 0; equal && j < A.cols(); ++j) equal = A(i, j) == B(i, j);
    is_so.push_back(equal);
    (equal ? same : other).push_back(n);
  }
  f.fate = fate(is_so);
  f.computed = "exact local matrices of both, entry by entry";
  if (!same.empty()) f.numbers["equal at valences"] = same;
  if (!other.empty()) f.numbers["different at valences"] = other;
  return f;
}

}  // namespace sublimit::report
