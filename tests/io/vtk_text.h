// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace batten {

/// The first tag of an XML text that contains `part`, from "<" to ">".
inline std::string tag_with(std::string_view text, std::string_view part) {
  const std::size_t at = text.find(part);
  if (at == std::string_view::npos) throw std::runtime_error("there is no tag with " + std::string(part));
  const std::size_t begin = text.rfind('<', at);
  return std::string(text.substr(begin, text.find('>', at) + 1 - begin));
}

/// The value of an attribute of a tag.
inline std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(' ' + name + "=\"");
  if (at == std::string::npos) throw std::runtime_error("there is no attribute " + name + " in " + tag);
  const std::size_t first = at + name.size() + 3;
  return tag.substr(first, tag.find('"', first) - first);
}

/// The numbers of the data array with this name in a VTK XML file with raw appended data: behind the underscore, at the
/// array's offset, stand the count of its bytes (64 bits) and the bytes.
template <class Number>
std::vector<Number> appended_array(const std::string& file, const std::string& name) {
  const std::size_t offset = std::stoul(attribute(tag_with(file, " Name=\"" + name + "\""), "offset"));
  const char* const data = file.data() + file.find('_', file.find("<AppendedData encoding=\"raw\">")) + 1 + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, data, sizeof bytes);
  std::vector<Number> numbers(bytes / sizeof(Number));
  std::memcpy(numbers.data(), data + sizeof bytes, bytes);
  return numbers;
}

}  // namespace batten
