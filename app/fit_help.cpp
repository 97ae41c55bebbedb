// SPDX-License-Identifier: MIT
#include <batten/app/fit_help.h>

namespace batten {

const char* const fit_help = R"(
The surface p is the B-spline on the grid that minimises

  sum_i w_i (p(x_i,y_i) - z_i)^2 / sum_i w_i  +  LAMBDA E(p)

with free (natural) sides. The energy E is the integral over the region of

  thin-plate   p_xx^2 + 2 p_xy^2 + p_yy^2
  membrane     p_x^2 + p_y^2
  tension      (1-T) thin-plate + T membrane

in normalised coordinates: the longer side of the region, y multiplied by the
aspect first, has length 1. LAMBDA is a pure number: it stays the same when the
coordinates or the values are given in other units. A tension T bends the
surface like a plate up to lengths of sqrt((1-T)/T) of the longer side and
stretches it like a membrane beyond.

--smoothing auto chooses LAMBDA by generalised cross-validation, none comes as
close to the points as the grid allows. --tolerance E gives the surface of
least energy with |p(x_i,y_i) - z_i| <= E at every point, to 0.1 % of that
energy; where the grid cannot come within E, the least E that it can is named.

--minimum V and --maximum V hold everywhere, between the points too, and with
every kind of smoothing (auto finds its LAMBDA without them). What is bounded
are the coefficients of the same surface on cells an eighth as wide, which it
lies between.

Examples:
  batten fit examples/data/topo.csv --x x --y y --value z -o topo.vti
  batten fit examples/data/rmprecip.csv --x lon --y lat --value precipitation --geographic -o rain.vti --picture rain.png --view map
  batten fit examples/data/rmprecip.csv --x lon --y lat --value precipitation --geographic --minimum 0 -o rain.vti)";

const char* const evaluate_help = R"(
Writes the columns x, y, value and, with --derivatives, dx, dy, dxx, dxy, dyy,
in the units of the data. Of what batten flow wrote: x, y, u, v, divergence,
vorticity, speed, stream_function (but for the model irrotational) and, with
--derivatives, u_x, u_y, v_x, v_y. Points outside the region of the result have empty
fields and are counted.

Example, after batten fit examples/data/topo.csv --x x --y y --value z -o topo.vti:
  batten evaluate topo.vti --at examples/data/topo.csv --derivatives -o there.csv)";

}  // namespace batten
