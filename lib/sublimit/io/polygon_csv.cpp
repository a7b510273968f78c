// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/polygon_files.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view name, bool tangents)
      : rest_(text), name_(name), tangents_(tangents) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // the byte order mark of UTF-8
  }

  ControlPolygon read() {
    bool between = true;  // the next point begins a curve
    for (std::string_view line; next_line(line);) {
      const bool comment = line.starts_with('#');
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty()) {
        between = between || !comment;
        continue;
      }
      const std::vector<std::string_view> fields = split(line);
      if (num_points_ == 0 && polygon_.columns.empty() && is_header(fields)) {
        for (const std::string_view field : fields) polygon_.columns.emplace_back(field);
        check_columns(fields.size());
        check_names(fields);
        continue;
      }
      check_columns(fields.size());
      for (size_t i = 0; i < fields.size(); ++i) values_.push_back(number(fields[i], i));
      if (between) polygon_.curves.emplace_back();
      between = false;
      polygon_.lines.push_back(line_);
      polygon_.curves.back().points.push_back(checked_index(num_points_++, name_, "points"));
    }
    if (num_points_ == 0)
      throw InvalidMesh(name_ + ": no points; write one a line, its coordinates separated by commas");
    polygon_.file = name_;
    const Points all = Eigen::Map<const Points>(values_.data(), num_points_, columns_);
    polygon_.points = tangents_ ? Points(all.leftCols(columns_ / 2)) : all;
    if (tangents_) polygon_.tangents = all.rightCols(columns_ / 2);
    if (tangents_ && columns_ == 6 && polygon_.columns.empty())
      polygon_.warnings.push_back(name_ +
                                  ": 6 columns without names are read as x,y,z,tx,ty,tz; second derivatives are "
                                  "not taken. A first line with the names of the columns says so");
    return std::move(polygon_);
  }

 private:
  std::string place() const { return name_ + ":" + format_number(line_) + ": "; }

  /// Lines end with LF, CRLF or CR.
  bool next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    ++line_;
    const size_t end = rest_.find_first_of("\r\n");
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size()
                                                      : end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1));
    return true;
  }

  static std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
      const size_t comma = line.find(',');
      fields.push_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return fields;
      line.remove_prefix(comma + 1);
    }
  }

  /// Names: words that begin with a letter and are no number (nan, inf).
  static bool is_header(const std::vector<std::string_view>& fields) {
    for (const std::string_view field : fields) {
      const char first = field.empty() ? '0' : field[0];
      const bool letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '_';
      if (!letter || parse_number<double>(field)) return false;
    }
    return true;
  }

  void check_columns(size_t count) {
    if (columns_ == 0) {
      columns_ = static_cast<Index>(count);
      if (tangents_ && (count < 4 || count % 2 != 0)) refuse_columns("");
    }
    if (static_cast<Index>(count) != columns_)
      throw FormatError(place() + format_number(count) + (count == 1 ? " value" : " values") +
                        " where the lines before have " + format_number(columns_) +
                        "; every point should have as many coordinates");
  }

  [[noreturn]] void refuse_columns(const std::string& why) const {
    throw FormatError(place() + format_number(columns_) + (columns_ == 1 ? " column" : " columns") + why +
                      "; points with tangents are expected, x,y,tx,ty or x,y,z,tx,ty,tz, and no other columns");
  }

  /// Names may be any. But where they begin with x, as coordinates do, no other column is taken for a coordinate.
  void check_names(const std::vector<std::string_view>& fields) const {
    constexpr std::string_view letters[] = {"x", "y", "z"};
    const auto letter_at = [&](size_t i) {
      return static_cast<size_t>(std::find(std::begin(letters), std::end(letters), fields[i]) - std::begin(letters));
    };
    size_t coordinates = 0;
    while (coordinates < fields.size() && coordinates < 3 && letter_at(coordinates) == coordinates) ++coordinates;
    for (size_t i = coordinates; i < fields.size(); ++i)
      if (letter_at(i) < 3)
        throw FormatError(place() + "column " + format_number(i + 1) + " is named " + in_quotes(fields[i]) +
                          ", which belongs to column " + format_number(letter_at(i) + 1) +
                          "; coordinates come first, in the order x,y,z");
    if (coordinates == 0) return;
    if (tangents_ && 2 * coordinates != fields.size())
      refuse_columns(", of which " + format_number(coordinates) + " are coordinates of points");
    const auto is_of_vector = [&](std::string_view name) {
      return name.size() > 1 &&
             std::find(std::begin(letters), std::end(letters), name.substr(name.size() - 1)) != std::end(letters);
    };
    for (size_t i = coordinates; i < fields.size() && !tangents_; ++i)
      if (is_of_vector(fields[i]))
        throw FormatError(place() + "column " + format_number(i + 1) + " is named " + in_quotes(fields[i]) +
                          ", as of a vector; points alone are expected, x,y or x,y,z");
  }

  double number(std::string_view field, size_t column) const {
    const std::string what = "value " + format_number(column + 1) + " of the line ";
    const Parsed<double> parsed = parse_number<double>(field);
    if (parsed.status == ParseStatus::too_large) throw FormatError(place() + what + in_quotes(field) + " is too large");
    if (!parsed)
      throw FormatError(place() + what + (field.empty() ? "is missing" : in_quotes(field) + " is not a number") +
                        "; it should be a decimal number, and numbers should be separated by commas");
    if (!std::isfinite(parsed.value))
      throw InvalidMesh(place() + what + "is " + in_quotes(field) + "; it should be a finite number");
    return parsed.value;
  }

  std::string_view rest_;
  std::string name_;
  bool tangents_;
  ControlPolygon polygon_;
  std::vector<double> values_;
  std::int64_t line_ = 0, num_points_ = 0;
  Index columns_ = 0;
};

void append_fields(std::string& out, const Eigen::Ref<const Eigen::RowVectorXd>& row) {
  for (const double value : row) {
    if (std::isfinite(value)) append_number(out, value);
    out += ',';
  }
}

}  // namespace

ControlPolygon parse_polygon_csv(std::string_view text, std::string_view name, bool tangents) {
  if (const size_t nul = text.find('\0'); nul != std::string_view::npos)
    throw FormatError(std::string(name) + ": byte " + format_number(nul) + " is zero, so this is not a text CSV file");
  return CsvReader(text, name, tangents).read();
}

std::string format_polygon_csv(const ControlPolygon& polygon) {
  const int dimension = polygon.dimension();
  std::string out;
  const auto names = [&](const char* prefix) {
    constexpr const char* letters[] = {"x", "y", "z"};
    for (int i = 0; i < dimension; ++i)
      out += prefix + (dimension <= 3 ? letters[i] : "x" + std::to_string(i + 1)) + ",";
  };
  if (static_cast<int>(polygon.columns.size()) == dimension * (polygon.has_tangents() ? 2 : 1)) {
    for (const std::string& column : polygon.columns) out += column + ",";
  } else {
    names("");
    if (polygon.has_tangents()) names("t");
  }
  out.back() = '\n';
  if (!polygon.points.allFinite()) throw InvalidMesh("points that are not finite cannot be written");
  bool first = true;
  for (const ControlPolygon::Curve& curve : polygon.curves) {
    if (!first) out += '\n';
    first = false;
    for (const Index i : curve.points) {
      append_fields(out, polygon.points.row(i));
      if (polygon.has_tangents()) append_fields(out, polygon.tangents.row(i));
      out.back() = '\n';
    }
  }
  return out;
}

}  // namespace sublimit
