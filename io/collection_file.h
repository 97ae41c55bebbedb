// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace batten {

/// A file of a series, and the time that it shows.
struct CollectionEntry {
  double time = 0;
  std::string file;  ///< relative to the folder of the collection
};

/// Writes a ParaView collection (.pvd): opening it in ParaView opens the series, with its times. Throws IoError.
void write_collection(const std::filesystem::path& path, std::span<const CollectionEntry> entries);

}  // namespace batten
