// SPDX-License-Identifier: MIT
#include <batten/app/chart_sheet.h>
#include <batten/io/output_file.h>
#include <batten/io/png.h>

#include <algorithm>

namespace batten {

void write_chart_sheet(const std::string& path, const std::vector<std::vector<Chart>>& rows) {
  const int width = rows.at(0).at(0).width, height = rows[0][0].height;
  std::size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  const auto line = static_cast<std::size_t>(3 * width);
  std::vector<std::uint8_t> rgb;
  for (const auto& row : rows)
    for (int y = 0; y < height; ++y)
      for (std::size_t c = 0; c < columns; ++c) {
        if (c >= row.size()) {
          rgb.insert(rgb.end(), line, 255);
          continue;
        }
        const auto begin = row[c].rgb.begin() + static_cast<std::ptrdiff_t>(line) * y;
        rgb.insert(rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(line));
      }
  OutputFile file(path);
  file.write(encode_png(static_cast<int>(columns) * width, static_cast<int>(rows.size()) * height, rgb));
  file.commit();
}

}  // namespace batten
