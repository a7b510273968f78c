// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/certificates/witness/witness.h"

#include <gtest/gtest.h>

#include <random>

#include <nlohmann/json.hpp>

namespace sublimit {
namespace {

using Json = nlohmann::json;

std::string witness_of(const std::string& name, int n, const SchemeOptions& options = {}) {
  C1Prover prover(*find_scheme<Algebraic>(name, options));
  return c1_witness(name, prover.certify(n), *prover.pieces());
}

std::string joined(const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& p : problems) all += p + "\n";
  return all;
}

TEST(Witness, ConvincesTheChecker) {
  for (const char* name : {"catmull-clark", "loop", "doo-sabin", "mid-edge", "mid-edge-habib-warren"})
    for (const int n : {4, 5}) {
      const std::string w = witness_of(name, n);
      EXPECT_EQ(joined(check_witness(w)), "") << name << " " << n;
      EXPECT_LT(w.size(), 100000u) << name;
    }
}

/// All values of a JSON document that are numbers or texts.
void collect(Json& j, std::vector<Json*>& all) {
  if (j.is_structured())
    for (Json& child : j) collect(child, all);
  else
    all.push_back(&j);
}

/// Another value of the same kind.
Json changed(const Json& j) {
  if (j.is_boolean()) return !j.get<bool>();
  if (j.is_number_integer()) return j.get<int>() + 1;
  if (j.is_number()) return j.get<double>() * 1.001;
  const std::string text = j;
  try {
    return (Algebraic::parse(text) + Algebraic::ratio(1, 1000003)).exact_text();
  } catch (const Error&) {
  }
  try {
    const Ball b = Ball::parse(text);
    return (b + Ball(1e-20)).exact_text();
  } catch (const Error&) {
  }
  try {
    return (ComplexBall::parse(text) + ComplexBall(Ball(0), Ball(1e-20))).exact_text();
  } catch (const Error&) {
  }
  return text + "0";  // words, and paths
}

TEST(Witness, IsRejectedWhateverNumberIsChanged) {
  for (const char* name : {"loop", "doo-sabin", "mid-edge"}) {
    const Json good = Json::parse(witness_of(name, 5));
    ASSERT_EQ(joined(check_witness(good.dump())), "") << name;
    std::mt19937 random(5);
    for (int trial = 0; trial < 60; ++trial) {
      Json bad = good;
      std::vector<Json*> values;
      collect(bad, values);
      Json& value = *values[random() % values.size()];
      if (value == name) continue;  // which scheme it says to be of is not for the checker to know
      const Json before = value;
      value = changed(value);
      EXPECT_NE(joined(check_witness(bad.dump())), "") << name << ": " << before << " became " << value;
    }
  }
}

TEST(Witness, IsRejectedWhereAPartIsCoveredTwiceAndAnotherNotAtAll) {
  // Areas add up to one piece, whatever the order: 00 lies within 0, and 33 is missing.
  const Json good = Json::parse(witness_of("doo-sabin", 5));
  const Json leaf = good["leaves"][0];
  ASSERT_EQ(leaf[3], "");
  for (const std::vector<std::string>& paths :
       {std::vector<std::string>{"00", "0", "1", "2", "30", "31", "32"}, {"0", "00", "1", "2", "30", "31", "32"}}) {
    Json bad = good;
    bad["leaves"].erase(0);
    for (const std::string& path : paths) {
      Json part = leaf;
      part[3] = path;
      bad["leaves"].push_back(part);
    }
    EXPECT_EQ(joined(check_witness(bad.dump())), "map: a part is there twice\n") << paths[0];
  }
}

TEST(Witness, IsRejectedWherePartsAreMissing) {
  const Json good = Json::parse(witness_of("doo-sabin", 5));
  for (const auto& [key, value] : good.items()) {
    if (key == "scheme") continue;
    Json bad = good;
    bad.erase(key);
    EXPECT_NE(joined(check_witness(bad.dump())), "") << key;
    if (!value.is_array()) continue;
    bad = good;
    bad[key].erase(bad[key].size() - 1);
    EXPECT_NE(joined(check_witness(bad.dump())), "") << "last of " << key;
  }
  EXPECT_NE(joined(check_witness("no JSON")), "");
}

}  // namespace
}  // namespace sublimit
