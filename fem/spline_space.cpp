// SPDX-License-Identifier: MIT
#include <batten/fem/spline_space.h>

#include <algorithm>

namespace batten {

void fill_images(const SplineSpace& space, std::span<double> c) {
  const std::ptrdiff_t nx = space.x.size(), ny = space.y.size();
  const std::ptrdiff_t x_images = space.x.images(), y_images = space.y.images();
  for (std::ptrdiff_t j = 0; j < ny && x_images > 0; ++j) {
    double* row = c.data() + j * nx;
    std::copy_n(row, x_images, row + nx - x_images);
  }
  std::copy_n(c.data(), y_images * nx, c.data() + (ny - y_images) * nx);
}

void fold_images(const SplineSpace& space, std::span<double> b) {
  const std::ptrdiff_t nx = space.x.size(), ny = space.y.size();
  const std::ptrdiff_t x_images = space.x.images(), y_images = space.y.images();
  const auto fold = [](double* image, double* original, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) original[i] += image[i];
    std::fill_n(image, count, 0.);
  };
  fold(b.data() + (ny - y_images) * nx, b.data(), y_images * nx);
  for (std::ptrdiff_t j = 0; j < ny - y_images && x_images > 0; ++j)
    fold(b.data() + (j + 1) * nx - x_images, b.data() + j * nx, x_images);
}

void to_unconstrained(const SplineSpace& space, std::span<double> c) {
  const std::ptrdiff_t nx = space.x.size(), ny = space.y.size();
  for (std::ptrdiff_t j = 0; j < ny; ++j) space.x.to_unconstrained(c.data() + j * nx, 1);
  for (std::ptrdiff_t i = 0; i < nx; ++i) space.y.to_unconstrained(c.data() + i, nx);
}

TensorSum subspace_restriction(const SplineSpace& space) {
  return TensorSum({{1., space.y.subspace_restriction(), space.x.subspace_restriction()}});
}

}  // namespace batten
