// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/grid_data.h>
#include <batten/io/vtk_output.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace batten {
namespace {

// Names in the field data. Version 1 has these and no others.
constexpr std::string_view version_name = "batten.version";
constexpr std::string_view kind_name = "batten.kind";
constexpr std::string_view degree_name = "batten.degree";
constexpr std::string_view cells_name = "batten.cells";
constexpr std::string_view region_name = "batten.region";
constexpr std::string_view array_prefix = "batten.array.";
constexpr std::string_view number_prefix = "batten.number.";
constexpr std::string_view text_prefix = "batten.text.";
constexpr int version = 1;

// Small values are copied: they need not outlive the call.
void add_numbers(vtkFieldData* data, std::string_view name, std::span<const double> values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(std::string(name).c_str());
  for (const double value : values) array->InsertNextValue(value);
  data->AddArray(array);
}

void add_integers(vtkFieldData* data, std::string_view name, std::span<const int> values) {
  vtkNew<vtkIntArray> array;
  array->SetName(std::string(name).c_str());
  for (const int value : values) array->InsertNextValue(value);
  data->AddArray(array);
}

void add_text(vtkFieldData* data, std::string_view name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(std::string(name).c_str());
  array->InsertNextValue(text);
  data->AddArray(array);
}

void add_record(vtkFieldData* data, const Record& record) {
  for (const auto& entry : record.numbers) check_name(entry.first);
  for (const auto& entry : record.texts) check_name(entry.first);
  add_integers(data, version_name, std::array{version});
  add_text(data, kind_name, record.kind);
  add_integers(data, degree_name, std::array{record.degree});
  add_integers(data, cells_name, record.cells);
  add_numbers(data, region_name, record.region);
  for (const auto& [name, values] : record.arrays) add_array(data, std::string(array_prefix) + name, values, 1);
  for (const auto& [name, value] : record.numbers) add_numbers(data, std::string(number_prefix) + name, {&value, 1});
  for (const auto& [name, text] : record.texts) add_text(data, std::string(text_prefix) + name, text);
}

// The numbers of a field array, `count` of them (any number if 0).
std::vector<double> numbers_of(vtkAbstractArray* array, std::size_t count, const std::string& file) {
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  const auto size = numbers ? static_cast<std::size_t>(numbers->GetNumberOfValues()) : 0;
  if (!numbers || (count != 0 && size != count)) {
    const std::string name = array && array->GetName() ? array->GetName() : "";
    throw InvalidInput(file + ": the field array '" + name + "' of Batten's record is missing or damaged");
  }
  if (auto* const doubles = vtkDoubleArray::SafeDownCast(numbers)) {
    return {doubles->GetPointer(0), doubles->GetPointer(0) + size};
  }
  std::vector<double> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = numbers->GetComponent(static_cast<vtkIdType>(i), 0);
  return values;
}

int integer_of(double value) { return static_cast<int>(std::lround(value)); }

std::string text_of(vtkAbstractArray* array) {
  auto* const text = vtkStringArray::SafeDownCast(array);
  return text && text->GetNumberOfValues() == 1 ? std::string(text->GetValue(0)) : std::string();
}

// Puts the array into the record if it belongs there.
void restore(vtkAbstractArray* array, const std::string& file, Record& record) {
  const std::string name = array->GetName() ? array->GetName() : "";
  const auto rest = [&](std::string_view prefix) { return name.substr(prefix.size()); };
  if (name.starts_with(array_prefix)) record.arrays[rest(array_prefix)] = numbers_of(array, 0, file);
  if (name.starts_with(number_prefix)) record.numbers[rest(number_prefix)] = numbers_of(array, 1, file)[0];
  if (name.starts_with(text_prefix)) record.texts[rest(text_prefix)] = text_of(array);
}

}  // namespace

void add_grid_data(vtkDataSet* set, const GridSamples& grid, const Record& record) {
  vtkPointData* const data = set->GetPointData();
  for (const PointArray& array : grid.arrays) {
    add_array(data, array.name, array.values, array.components);
    const char* const name = array.name.c_str();
    const bool is_scalar = array.name == "value" || array.name == "speed";
    const bool is_vector = array.name == "gradient" || array.name == "velocity";
    if (is_scalar && array.components == 1) data->SetActiveScalars(name);
    if (is_vector && array.components == 3) data->SetActiveVectors(name);
  }
  for (const PointArray& array : grid.cell_arrays)
    add_array(set->GetCellData(), array.name, array.values, array.components);
  add_record(set->GetFieldData(), record);
}

Record record_in(vtkDataSet* set, const std::string& file) {
  vtkFieldData* const data = set->GetFieldData();
  const auto array = [&](std::string_view name) { return data->GetAbstractArray(std::string(name).c_str()); };
  if (!array(version_name)) throw InvalidInput(file + ": was not written by Batten (it has no record)");
  const int found = integer_of(numbers_of(array(version_name), 1, file)[0]);
  if (found != version) {
    throw InvalidInput(file + ": its record has version " + std::to_string(found) + ", this Batten reads version " +
                       std::to_string(version));
  }
  Record record;
  record.kind = text_of(array(kind_name));
  record.degree = integer_of(numbers_of(array(degree_name), 1, file)[0]);
  const std::vector<double> cells = numbers_of(array(cells_name), 2, file);
  record.cells = {integer_of(cells[0]), integer_of(cells[1])};
  const std::vector<double> region = numbers_of(array(region_name), 4, file);
  std::copy(region.begin(), region.end(), record.region.begin());
  for (int k = 0; k < data->GetNumberOfArrays(); ++k) restore(data->GetAbstractArray(k), file, record);
  return record;
}

}  // namespace batten
