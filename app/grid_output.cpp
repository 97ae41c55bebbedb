// SPDX-License-Identifier: MIT
#include <batten/app/grid_output.h>
#include <batten/app/output_names.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>
#include <batten/io/table.h>

namespace batten {

void write_grid_outputs(const SubdivideArguments& arguments, const std::string& what, const GridSamples& samples) {
  if (is_table(arguments.output)) {
    write_table(arguments.output, samples);
  } else {
    const auto [x, y] = samples.origin;
    Record record{.kind = "subdivided grid",
                  .region = {x, x + samples.spacing[0] * (samples.points[0] - 1), y,
                             y + samples.spacing[1] * (samples.points[1] - 1)}};
    record.texts = {{"scheme", what}, {"program", "batten " BATTEN_VERSION}};
    record.numbers = {{"levels", static_cast<double>(arguments.levels)}};
    write_image(arguments.output, samples, record);
  }
  if (arguments.picture.empty()) return;
  PictureOptions options;
  options.view = arguments.view == "map" ? PictureOptions::View::Map : PictureOptions::View::Surface;
  options.title = what + ", " + std::to_string(arguments.levels) + " levels";
  write_picture(arguments.picture, samples, {}, options);
}

}  // namespace batten
