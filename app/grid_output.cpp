// SPDX-License-Identifier: MIT
#include <batten/app/grid_output.h>
#include <batten/app/sample_file.h>
#include <batten/io/picture.h>

namespace batten {

void write_subdivided(const SubdivideArguments& arguments, const std::string& kind, const std::string& what,
                      const GridSamples& samples) {
  const auto [x, y] = samples.origin;
  Record record{.kind = kind,
                .region = {x, x + samples.spacing[0] * (samples.points[0] - 1), y,
                           y + samples.spacing[1] * (samples.points[1] - 1)}};
  record.texts = {{"scheme", what}, {"program", "batten " BATTEN_VERSION}};
  record.numbers = {{"levels", static_cast<double>(arguments.levels)}};
  write_samples(arguments.output, samples, record);
}

void write_grid_outputs(const SubdivideArguments& arguments, const std::string& what, const GridSamples& samples) {
  write_subdivided(arguments, "subdivided grid", what, samples);
  if (arguments.picture.empty()) return;
  PictureOptions options;
  options.view = arguments.view == "map" ? PictureOptions::View::Map : PictureOptions::View::Surface;
  options.title = what + ", " + std::to_string(arguments.levels) + " levels";
  write_picture(arguments.picture, samples, {}, options);
}

}  // namespace batten
