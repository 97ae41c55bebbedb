// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/png.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace batten {

std::string encode_png(int width, int height, std::span<const std::uint8_t> rgb) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto row = static_cast<std::ptrdiff_t>(3 * width);
  for (int j = 0; j < height; ++j) {  // VTK's rows go upwards
    const auto from = rgb.begin() + (height - 1 - j) * row;
    std::copy(from, from + row, static_cast<std::uint8_t*>(image->GetScalarPointer(0, j, 0)));
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  if (!bytes) throw IoError("encode_png: the picture cannot be encoded");
  const auto count = static_cast<std::size_t>(bytes->GetNumberOfValues());
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), count};
}

}  // namespace batten
