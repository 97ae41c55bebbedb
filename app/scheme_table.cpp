// SPDX-License-Identifier: MIT
#include <batten/app/scheme_account.h>
#include <batten/domains/number_text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t margin = 22;  // where the second column begins

std::string text_of(const Json& v) {
  if (v.is_string()) return v.get<std::string>();
  if (v.is_number_float()) return number_text(v.get<double>(), 12);
  if (!v.is_array()) return v.dump();
  std::string text;
  for (const Json& part : v) text += (text.empty() ? "" : ", ") + text_of(part);
  return v.empty() || !v[0].is_array() ? "[" + text + "]" : text;
}

void write_line(std::ostream& out, const std::string& name, const std::string& text) {
  out << name << std::string(name.size() + 2 < margin ? margin - name.size() : 2, ' ') << text << '\n';
}

/// The columns of rows under each other, the highest power of y first, as the plane is drawn.
void write_rows(std::ostream& out, const Json& rows) {
  std::size_t widest = 0;
  for (const Json& row : rows)
    for (const Json& v : row) widest = std::max(widest, text_of(v).size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    out << std::string(margin, ' ');
    for (const Json& v : *row) out << std::string(widest - text_of(v).size(), ' ') << text_of(v) << "  ";
    out << '\n';
  }
}

/// Coefficients and where they begin.
void write_polynomial(std::ostream& out, const std::string& name, const Json& polynomial) {
  const Json& coefficients = polynomial["coefficients"];
  const Json& offset = polynomial["offset"];
  if (coefficients.empty()) return write_line(out, name, "0 everywhere");
  if (!coefficients[0].is_array()) {
    const std::string list = text_of(coefficients);
    return write_line(out, name, list.substr(1, list.size() - 2) + "   from " + text_of(offset));
  }
  write_line(out, name, "lower left at (" + text_of(offset[0]) + ", " + text_of(offset[1]) + "), y upwards");
  write_rows(out, coefficients);
}

void write_entry(std::ostream& out, const std::string& name, const Json& value) {
  if (!value.is_object()) return write_line(out, name, text_of(value));
  if (value.contains("coefficients")) return write_polynomial(out, name, value);
  const std::string kind = name == "derivatives" ? "derivative " : name == "inner_products" ? "inner product " : "";
  for (const auto& [key, part] : value.items()) write_entry(out, kind + key, part);
}

}  // namespace

std::string scheme_table(const std::string& account, const std::string& mask) {
  std::ostringstream out;
  const Json json = Json::parse(account);
  for (const auto& [key, value] : json.items()) {
    if (key == "mask" && !mask.empty())
      write_line(out, key, mask);
    else
      write_entry(out, key, value);
  }
  return out.str();
}

}  // namespace batten
