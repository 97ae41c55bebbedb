// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/file_size_signal.h>
#include <batten/io/output_file.h>
#include <batten/io/vtk_errors.h>
#include <batten/io/vtk_output.h>

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataObjectWriter.h>
#include <vtkXMLWriter.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace batten {
namespace {

// Does the file end as a complete VTK XML file does?
bool is_complete(const std::filesystem::path& path) {
  constexpr std::string_view expected = "</VTKFile>\n";
  std::array<char, expected.size()> tail = {};
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  file.read(tail.data(), tail.size());
  return file && std::string_view(tail.data(), tail.size()) == expected;
}

}  // namespace

void check_name(const std::string& name) {
  const bool safe = std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) >= ' ' && std::string_view("<>&\"").find(c) == std::string_view::npos;
  });
  if (!safe) throw InvalidInput("array name '" + name + "': control characters and <>&\" are not allowed in VTK files");
}

void add_array(vtkFieldData* data, const std::string& name, std::span<const double> values, int components) {
  check_name(name);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): VTK has no arrays of constants
  auto* const data_of_caller = const_cast<double*>(values.data());
  constexpr int keep = 1;  // VTK does not free what is not its own; the writers only read it
  array->SetArray(data_of_caller, static_cast<vtkIdType>(values.size()), keep);
  data->AddArray(array);
}

void write_vtk(const std::filesystem::path& path, vtkDataObject* data) {
  OutputFile file(path);
  const FileSizeSignalBlock block;  // outlives the writer, whose stream may write once more when it closes
  const VtkErrors errors;
  const auto writer = vtkSmartPointer<vtkXMLWriter>::Take(vtkXMLDataObjectWriter::NewWriter(data->GetDataObjectType()));
  errors.listen(writer);
  writer->SetInputDataObject(data);
  writer->SetFileName(file.temporary_path().c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError && !errors.heard();
  if (!written || !is_complete(file.temporary_path())) {
    const unsigned long code = writer->GetErrorCode();
    const char* const reason =
        code == vtkErrorCode::NoError ? "incomplete" : vtkErrorCode::GetStringFromErrorCode(code);
    throw IoError(path.string() + ": cannot be written: " + reason);
  }
  file.commit();
}

}  // namespace batten
