// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

class vtkRenderer;

namespace batten {

/// A window of VTK that needs no display: it draws into memory, through an EGL context of its own.
class OffscreenWindow {
public:
  /// Throws IoError if no context can be had.
  OffscreenWindow(int width, int height);
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  /// The renderer of the whole window, with a white background.
  vtkRenderer* renderer() const;

  /// Draws; three bytes per pixel, row by row from the top.
  std::vector<std::uint8_t> render() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace batten
