// SPDX-License-Identifier: MIT
#include <batten/bench/support/point_table.h>
#include <batten/bench/support/test_surface.h>

#include <charconv>
#include <fstream>
#include <stdexcept>

namespace batten {

void write_point_table(const std::string& file, std::size_t count) {
  RandomPoints points;
  std::ofstream out(file, std::ios::binary);
  out << "# x\ty\tz\n";
  char line[100];
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = points.next();
    char* end = line;
    for (double value : {x, y, franke(x, y)}) {
      end = std::to_chars(end, line + sizeof line - 1, value).ptr;
      *end++ = '\t';
    }
    end[-1] = '\n';
    out.write(line, end - line);
  }
  if (!out.flush()) throw std::runtime_error("cannot write '" + file + "'");
}

}  // namespace batten
