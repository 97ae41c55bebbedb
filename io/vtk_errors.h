// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

class vtkAlgorithm;
class vtkCommand;

namespace batten {

/// Hears the errors of VTK objects, which would otherwise be printed.
class VtkErrors {
public:
  VtkErrors();
  ~VtkErrors();
  VtkErrors(const VtkErrors&) = delete;
  VtkErrors& operator=(const VtkErrors&) = delete;

  /// Hears an algorithm and what runs it.
  void listen(vtkAlgorithm* algorithm) const;

  /// For what takes an observer itself.
  vtkCommand* observer() const;
  bool heard() const;

private:
  class Listener;
  std::unique_ptr<Listener, void (*)(Listener*)> listener_;
};

}  // namespace batten
