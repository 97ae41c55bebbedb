// SPDX-License-Identifier: MIT
#include <batten/io/collection_file.h>
#include <batten/io/output_file.h>

#include <array>
#include <charconv>
#include <string_view>

namespace batten {
namespace {

/// For an attribute of XML.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// The shortest text that reads back as the same double.
std::string shortest(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

void write_collection(const std::filesystem::path& path, std::span<const CollectionEntry> entries) {
  OutputFile file(path);
  file.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n");
  for (const auto& [time, name] : entries)
    file.write("    <DataSet timestep=\"" + shortest(time) + "\" file=\"" + escaped(name) + "\"/>\n");
  file.write("  </Collection>\n</VTKFile>\n");
  file.commit();
}

}  // namespace batten
