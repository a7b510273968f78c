// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/statements.h"

#include "sublimit/base/parallel_for.h"

namespace sublimit::report {

Json to_json(std::span<const Statement> statements) {
  std::vector<Finding> findings(statements.size());
  parallel_for_blocks(
      static_cast<std::int64_t>(statements.size()),
      [&](std::int64_t, std::int64_t i, std::int64_t) {
        findings[static_cast<size_t>(i)] = statements[static_cast<size_t>(i)].experiment();
      },
      1);
  Json list = Json::array();
  for (size_t i = 0; i < statements.size(); ++i) {
    const Statement& s = statements[i];
    list.push_back({{"where", s.where},
                    {"says", s.says},
                    {"verdict", to_string(findings[i].fate)},
                    {"right", *s.right ? Json(s.right) : Json()},
                    {"experiment", findings[i].computed},
                    {"numbers", findings[i].numbers}});
  }
  return list;
}

}  // namespace sublimit::report
