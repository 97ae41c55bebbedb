// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/grid_data.h>
#include <batten/io/image_file.h>
#include <batten/io/sample_checks.h>
#include <batten/io/vtk_errors.h>
#include <batten/io/vtk_output.h>

#include <vtkDataArraySelection.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>

namespace batten {
namespace {

// The reader of the file's type.
vtkSmartPointer<vtkXMLReader> reader_of(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw IoError(path.string() + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw IoError(path.string() + ": is a folder, a file is expected");
  constexpr std::size_t head_size = 1024;
  std::string head(head_size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path.string() + ": cannot be read");
  file.read(head.data(), head_size);
  const auto holds = [&](const char* word) { return head.find(word) != std::string::npos; };
  if (holds("<VTKFile") && holds("ImageData")) return vtkSmartPointer<vtkXMLImageDataReader>::New();
  if (holds("<VTKFile") && holds("UnstructuredGrid")) return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  throw InvalidInput(path.string() + ": is neither a VTK image file (.vti) nor an unstructured grid (.vtu)");
}

}  // namespace

void write_image(const std::filesystem::path& path, const GridSamples& grid, const Record& record) {
  check_arrays(grid, "write_image");
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.points[0], grid.points[1], 1);
  image->SetOrigin(grid.origin[0], grid.origin[1], 0);
  image->SetSpacing(grid.spacing[0], grid.spacing[1], 1);
  add_grid_data(image, grid, record);
  write_vtk(path, image);
}

Record read_record(const std::filesystem::path& path) {
  const VtkErrors errors;
  const auto reader = reader_of(path);
  errors.listen(reader);
  reader->SetReaderErrorObserver(errors.observer());
  reader->SetParserErrorObserver(errors.observer());
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableAllArrays();
  reader->GetCellDataArraySelection()->DisableAllArrays();
  reader->Update();
  if (errors.heard() || reader->GetErrorCode() != vtkErrorCode::NoError) {
    throw IoError(path.string() + ": cannot be read as a VTK file; it is damaged or incomplete");
  }
  return record_in(reader->GetOutputAsDataSet(), path.string());
}

}  // namespace batten
