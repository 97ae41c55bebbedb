// SPDX-License-Identifier: MIT
#include <batten/app/nearest_name.h>
#include <batten/app/polyharmonic_mask.h>
#include <batten/app/scheme_catalogue.h>
#include <batten/app/scheme_options.h>
#include <batten/app/usage_error.h>
#include <batten/bases/box_spline.h>
#include <batten/bases/bspline_scheme.h>
#include <batten/bases/exponential_scheme.h>
#include <batten/bases/interpolatory_schemes.h>
#include <batten/bases/mask_text.h>
#include <batten/bases/tension_scheme.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace batten {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

[[noreturn]] void refuse(const std::string& option, const std::string& expected, const std::string& text) {
  throw UsageError(option + ": expected " + expected + ", found '" + text + "'");
}

/// One term of a complex number, "2", "-i" or "+3.5i"; moves `at` behind it.
std::complex<double> complex_term(const std::string& text, std::size_t& at) {
  const double sign = text[at] == '-' ? -1 : 1;
  if (text[at] == '+' || text[at] == '-') ++at;
  double size = 1;
  const auto found = std::from_chars(text.data() + at, text.data() + text.size(), size);
  const bool has_number = found.ec == std::errc();
  if (has_number) at = static_cast<std::size_t>(found.ptr - text.data());
  if (at < text.size() && text[at] == 'i') return ++at, std::complex<double>(0, sign * size);
  if (!has_number) at = std::string::npos;
  return sign * size;
}

Directions directions_of(const SchemeArguments& a) {
  Directions directions;
  for (const auto& row : parse_integers("--directions", *a.directions)) {
    if (row.size() != 2) refuse("--directions", "pairs as in \"1,0;0,1;1,1\"", *a.directions);
    directions.push_back({row[0], row[1]});
  }
  return directions;
}

/// The weight that was asked for, or nothing for the scheme's own.
template <class Make>
auto with_weight(const SchemeArguments& a, const Make& make, const Rational& usual) {
  return make(a.weight ? parse_rational(*a.weight) : usual);
}

AnyScheme custom_of(const SchemeArguments& a) {
  const int arity = a.arity.value_or(2);
  const auto offset = parse_integers("--offset", a.offset.value_or("0"));
  if (a.mask->find(';') == std::string::npos) {
    if (offset.size() != 1 || offset[0].size() != 1) refuse("--offset", "one integer", *a.offset);
    return custom_scheme<1>(parse_mask(*a.mask, offset[0][0]), arity);
  }
  if (offset.size() != 1 || offset[0].size() > 2) refuse("--offset", "two integers as in \"-1,-1\"", *a.offset);
  const Index<2> first = {offset[0][0], offset[0].back()};
  return custom_scheme<2>(parse_mask2(*a.mask, first), arity);
}

struct Entry {
  const char* name;
  std::vector<std::string> needs, may;  ///< options
  AnyScheme (*make)(const SchemeArguments&);
};

const std::vector<Entry>& catalogue() {
  using A = const SchemeArguments&;
  static const std::vector<Entry> entries = {
      {"bspline",
       {"--order"},
       {"--arity"},
       [](A a) -> AnyScheme { return bspline_scheme(*a.order, a.arity.value_or(2)); }},
      {"box", {"--directions"}, {}, [](A a) -> AnyScheme { return box_scheme(directions_of(a)); }},
      {"exponential",
       {"--roots"},
       {},
       [](A a) -> AnyScheme { return exponential_scheme(parse_complex("--roots", *a.roots)); }},
      {"tension", {"--sigma"}, {}, [](A a) -> AnyScheme { return tension_scheme(*a.sigma); }},
      {"four-point", {}, {"--w"}, [](A a) -> AnyScheme { return with_weight(a, four_point_scheme, Rational(1, 16)); }},
      {"deslauriers-dubuc", {"--points"}, {}, [](A a) -> AnyScheme { return deslauriers_dubuc_scheme(*a.points); }},
      {"six-point", {}, {"--w"}, [](A a) -> AnyScheme { return with_weight(a, six_point_scheme, Rational(3, 256)); }},
      {"ternary-four-point",
       {},
       {"--w"},
       [](A a) -> AnyScheme { return with_weight(a, ternary_four_point_scheme, Rational(1, 10)); }},
      {"butterfly", {}, {"--w"}, [](A a) -> AnyScheme { return with_weight(a, butterfly_scheme, Rational(1, 16)); }},
      {"quad-interpolatory", {}, {}, [](A) -> AnyScheme { return quad_interpolatory_scheme(); }},
      {"polyharmonic",
       {"--order"},
       {"--method", "--size", "--precision", "--relaxation", "--symmetry", "--shape", "--zeros"},
       [](A a) -> AnyScheme { return polyharmonic_scheme_of(a); }},
      {"custom", {"--mask"}, {"--offset", "--arity"}, custom_of},
  };
  return entries;
}

bool holds(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

const Entry& entry_of(const SchemeArguments& arguments) {
  const auto& entries = catalogue();
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == arguments.name; });
  if (entry == entries.end()) throw UsageError(unknown_scheme_text(arguments.name, scheme_names()));
  return *entry;
}

}  // namespace

std::vector<const char*> scheme_names() {
  std::vector<const char*> names;
  for (const Entry& entry : catalogue()) names.push_back(entry.name);
  return names;
}

std::string unknown_scheme_text(const std::string& name, std::span<const char* const> names) {
  return "there is no scheme '" + name + "'; did you mean '" + nearest_name(name, names) + "'? The schemes are " +
         name_list(names);
}

void check_options(const SchemeArguments& arguments, const std::vector<std::string>& needs,
                   const std::vector<std::string>& may) {
  const auto given = making_options_given(arguments);
  for (const std::string& option : needs)
    if (!holds(given, option)) throw UsageError(arguments.name + " needs " + option);
  for (const std::string& option : given)
    if (!holds(needs, option) && !holds(may, option)) throw UsageError(arguments.name + " has no option " + option);
}

void check_scheme_options(const SchemeArguments& arguments) {
  const Entry& entry = entry_of(arguments);
  check_options(arguments, entry.needs, entry.may);
}

AnyScheme scheme_of(const SchemeArguments& arguments) {
  check_scheme_options(arguments);
  return entry_of(arguments).make(arguments);
}

std::vector<std::vector<int>> parse_integers(const std::string& option, const std::string& text) {
  std::vector<std::vector<int>> rows;
  for (const std::string& row : split(text, ';')) {
    rows.emplace_back();
    for (const std::string& word : split(row, ',')) {
      int value = 0;
      const auto found = std::from_chars(word.data(), word.data() + word.size(), value);
      if (found.ec != std::errc() || found.ptr != word.data() + word.size())
        refuse(option, "integers separated by , and ;", text);
      rows.back().push_back(value);
    }
  }
  return rows;
}

std::vector<std::complex<double>> parse_complex(const std::string& option, const std::string& text) {
  std::vector<std::complex<double>> values;
  for (const std::string& word : split(text, ',')) {
    std::complex<double> value = 0;
    std::size_t at = 0;
    for (int terms = 0; at < word.size() && terms < 2; ++terms) value += complex_term(word, at);
    if (word.empty() || at != word.size()) refuse(option, "numbers such as 0, -1.5 or 1+2i separated by commas", text);
    values.push_back(value);
  }
  return values;
}

}  // namespace batten
