// SPDX-License-Identifier: MIT
#include <batten/io/vtk_errors.h>

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>

namespace batten {

class VtkErrors::Listener : public vtkCommand {
public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject*, unsigned long, void*) override { heard = true; }
  bool heard = false;
};

VtkErrors::VtkErrors() : listener_(Listener::New(), [](Listener* listener) { listener->Delete(); }) {}
VtkErrors::~VtkErrors() = default;  // VTK counts its own references to the listener

void VtkErrors::listen(vtkAlgorithm* algorithm) const {
  algorithm->AddObserver(vtkCommand::ErrorEvent, observer());
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer());
}

vtkCommand* VtkErrors::observer() const { return listener_.get(); }
bool VtkErrors::heard() const { return listener_->heard; }

}  // namespace batten
