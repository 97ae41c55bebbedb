// SPDX-License-Identifier: MIT
#pragma once

#include <batten/domains/rectangle.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace batten {

/// A coefficient, load or boundary datum: a constant or a function of position, in the units of the problem.
class Field {
public:
  using Function = std::function<double(double x, double y)>;

  Field(double constant = 0) : constant_(constant) {}
  /// `function` is called from several threads at once.
  Field(Function function) : function_(std::move(function)) {}

  bool is_constant() const { return !function_; }
  /// True for the constant 0.
  bool is_zero() const { return is_constant() && constant_ == 0; }
  double operator()(double x, double y) const { return function_ ? function_(x, y) : constant_; }
  /// factor times this field plus a constant.
  Field affine(double factor, double constant = 0) const {
    if (is_constant() || factor == 0) return factor * constant_ + constant;
    return Field([f = function_, factor, constant](double x, double y) { return factor * f(x, y) + constant; });
  }

private:
  double constant_ = 0;
  Function function_;
};

/// The condition on one side of the rectangle. What is not prescribed is natural: no flux for a Poisson problem, no
/// moment and no force for a plate (its free corners included).
///
///   value    u = value
///   normal   ∂u/∂n = normal, n the outward normal. A flux k·normal for Poisson problems, prescribed strongly for
///   plates both     plates only
struct Side {
  std::optional<Field> value, normal;
  bool periodic = false;  ///< on both of two opposite sides

  static Side free() { return {}; }
  static Side fixed(Field value = {}) { return {std::move(value), {}, false}; }
  static Side simply_supported() { return fixed(); }
  static Side clamped(Field value = {}, Field normal = {}) { return {std::move(value), std::move(normal), false}; }
  static Side sloped(Field normal) { return {{}, std::move(normal), false}; }
  static Side symmetry() { return sloped(0.); }
  static Side repeated() { return {{}, {}, true}; }
};

struct Sides {
  Side left, right, bottom, top;
};

/// ∫∫ (k |∇u|² + c u²) : -div(k ∇u) + c u = f. k > 0, c >= 0.
struct Conduction {
  Field k = 1, c = 0;
};

/// ∫∫ D (w_xx² + 2 ν w_xx w_yy + w_yy² + 2 (1 - ν) w_xy²) + T |∇w|² + c w² : D Δ²w - T Δw + c w = q for constant D.
/// D > 0, T >= 0, c >= 0, -1 <= ν <= 0.5. At ν = -1 x² + y² has no energy either: some side must be clamped then.
struct KirchhoffPlate {
  Field rigidity = 1;  ///< D
  double poisson_ratio = 0.3;
  Field foundation = 0;  ///< c (Winkler)
  Field tension = 0;     ///< T
};

/// What acts on the plate or membrane: f or q over the whole rectangle, and the rest added to it.
///
/// Couples act on slopes: they do the work mx ∂u/∂x + my ∂u/∂y.
struct Loads {
  struct Point {
    double x = 0, y = 0, value = 0;
  };
  struct Line {
    std::array<double, 2> from = {0, 0}, to = {0, 0};
    Field value;  ///< per unit of length
  };
  struct Patch {
    std::array<double, 2> x = {0, 0}, y = {0, 0};  ///< lower and upper end
    Field q;                                       ///< per unit of area
  };
  struct Couple {
    double x = 0, y = 0, mx = 0, my = 0;
  };
  Field area;
  std::vector<Point> points;
  std::vector<Line> lines;
  std::vector<Patch> patches;
  Field area_mx, area_my;       ///< couples per unit of area
  std::vector<Couple> couples;  ///< plates only: slopes of membranes are not bounded at a point
};

/// Prescribed values inside the rectangle.
struct Supports {
  struct Point {
    double x = 0, y = 0, value = 0;
    double radius = 0;  ///< of a peg; Poisson problems need one, since the value at a point is not bounded there
  };
  struct Line {
    std::array<double, 2> from = {0, 0}, to = {0, 0};
    Field value;
  };
  std::vector<Point> points;
  std::vector<Line> lines;
};

/// A boundary value problem on a rectangle, for a spline of the given degree on its cells.
struct BoundaryProblem {
  std::variant<Conduction, KirchhoffPlate> material;
  Rectangle region;
  int degree = 3;  ///< 1 to 5 for Conduction, 2 to 5 for KirchhoffPlate
  Sides sides;
  Loads loads;
  Supports supports;

  bool is_plate() const { return std::holds_alternative<KirchhoffPlate>(material); }
};

}  // namespace batten
