// SPDX-License-Identifier: MIT
#include <batten/app/output_names.h>
#include <batten/app/sample_file.h>
#include <batten/io/image_file.h>
#include <batten/io/quad_file.h>
#include <batten/io/table.h>

namespace batten {

void write_samples(const std::string& file, const GridSamples& samples, const Record& record) {
  if (is_table(file)) return write_table(file, samples);
  file.ends_with(".vtu") ? write_quads(file, samples, record) : write_image(file, samples, record);
}

}  // namespace batten
