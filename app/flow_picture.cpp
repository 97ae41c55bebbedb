// SPDX-License-Identifier: MIT
#include <batten/app/flow_picture.h>

namespace batten {

void draw_flow_picture(const FlowPicture& picture, const GridSamples& samples) {
  PictureOptions options;
  options.view = PictureOptions::View::Map;
  options.array = options.value_name = "speed";
  options.title = picture.title;
  if (picture.pixels) {
    options.width = (*picture.pixels)[0];
    options.height = (*picture.pixels)[1];
  }
  options.x_name = picture.names[0];
  options.y_name = picture.names[1];
  options.y_scale = picture.y_scale;
  options.contours = false;
  options.curves = picture.curves;
  options.heads = picture.heads;
  write_picture(picture.path, samples, {}, options);
}

}  // namespace batten
