// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/page.h"
#include "sublimit/report/page/style.h"

namespace sublimit {

std::string report_picture(const nlohmann::ordered_json& report) {
  const std::string html = report_page(report);
  const size_t begin = html.find("<svg");
  if (begin == std::string::npos) return {};
  size_t end = begin, at = begin;
  for (int depth = 0; at != std::string::npos;) {  // pictures may hold pictures
    const size_t open = html.find("<svg", at), close = html.find("</svg>", at);
    if (open < close) {
      ++depth;
      at = open + 4;
    } else {
      at = end = close + 6;
      if (--depth == 0) break;
    }
  }
  std::string svg = html.substr(begin, end - begin);
  const size_t head = svg.find('>');
  const std::string name_space =
      svg.substr(0, head).find("xmlns=") == std::string::npos ? " xmlns=\"http://www.w3.org/2000/svg\"" : "";
  svg.insert(head + 1, std::string("<style>") + page::style + "</style>");
  svg.insert(4, name_space);
  return svg + "\n";
}

}  // namespace sublimit
