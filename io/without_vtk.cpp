// SPDX-License-Identifier: MIT
// What stands in for image_file, quad_file, point_file, curve_file, picture, chart, png and vtk_support where Batten is
// built without VTK.
#include <batten/domains/errors.h>
#include <batten/io/chart.h>
#include <batten/io/curve_file.h>
#include <batten/io/image_file.h>
#include <batten/io/picture.h>
#include <batten/io/png.h>
#include <batten/io/point_file.h>
#include <batten/io/quad_file.h>
#include <batten/io/vtk_support.h>

namespace batten {
namespace {

[[noreturn]] void refuse(const std::string& subject, const std::string& advice) {
  throw IoError(subject + ": this build of Batten has no VTK" + advice);
}

}  // namespace

bool has_vtk() { return false; }

void write_image(const std::filesystem::path& path, const GridSamples&, const Record&) {
  refuse(path.string(), " and cannot write .vti files; write .csv");
}

void write_quads(const std::filesystem::path& path, const GridSamples&, const Record&) {
  refuse(path.string(), " and cannot write .vtu files; write .csv");
}

Record read_record(const std::filesystem::path& path) { refuse(path.string(), " and cannot read .vti files"); }

void write_points(const std::filesystem::path& path, const ScatteredSamples&) {
  refuse(path.string(), " and cannot write .vtp files; write .csv");
}

void write_curves(const std::filesystem::path& path, std::span<const CurveSamples>) {
  refuse(path.string(), " and cannot write .vtp files; write .csv");
}

Chart draw_chart(std::span<const ChartLine>, const ChartOptions&) { refuse("draw_chart", " and cannot draw pictures"); }

void write_chart(const std::filesystem::path& path, std::span<const ChartLine>, const ChartOptions&) {
  refuse(path.string(), " and cannot draw pictures");
}

std::string encode_png(int, int, std::span<const std::uint8_t>) { refuse("encode_png", " and cannot draw pictures"); }

Picture draw_picture(const GridSamples&, const ScatteredSamples&, const PictureOptions&) {
  refuse("draw_picture", " and cannot draw pictures");
}

void write_picture(const std::filesystem::path& path, const GridSamples&, const ScatteredSamples&,
                   const PictureOptions&) {
  refuse(path.string(), " and cannot draw pictures");
}

}  // namespace batten
