// SPDX-License-Identifier: MIT
#include <batten/app/flow_help.h>

namespace batten {

const char* const flow_help = R"(
The field (u, v) is the one on the grid that minimises

  sum_i w_i |(u,v)(x_i,y_i) - (u_i,v_i)|^2 / (2 sum_i w_i)  +  LAMBDA E

psi and phi are B-splines, E an integral over the region:

  smooth        u = psi_y, v = -psi_x    third derivatives of psi
  slow          u = psi_y, v = -psi_x    second derivatives of psi
  irrotational  u = phi_x, v = phi_y     third derivatives of phi
  general       the sum of both          of psi and R times those of phi

in normalised coordinates: the longer side of the region has length 1. smooth
and slow have no divergence at any point. slow leaves spikes at the vectors if
they are not smoothed. Measured wind and surface currents have divergence: take
general for these.

--smoothing auto chooses LAMBDA by generalised cross-validation, none comes as
close to the vectors as the grid allows. --tolerance E keeps u and v within E
each, or with --tolerance-norm euclidean the length of the difference, with the
least energy.

Sides are free unless --walls, --no-slip or --periodic say more. psi is constant
on walls that are connected; the flux between two that are not, and the mean flow
along a periodic direction, are found by the fit and reported: of general, whose
flow changes from section to section, as means. general with --no-slip needs a
free side.

--geographic: x is the longitude and y the latitude, on a sphere of 6371 km;

  smooth, slow  u = -psi_lat / R, v = psi_lon / (R cos lat)    no divergence on it
  irrotational  u = phi_lon / (R cos lat), v = phi_lat / R     no vorticity

Lengths are in km, psi in the unit of u times km, divergence and vorticity in that
of u per km. E counts one degree of latitude as 1 / cos(mid latitude) degrees of
longitude. Regions lie between the poles.

--streamlines N traces N lines of the flow, each through the place farthest from
those before, to the sides, points at rest or ten longer sides away; --parameter
spaces their points evenly in length or time.

Examples:
  batten flow examples/data/wind.csv --x longitude --y latitude --u u --v v --geographic --model general --smoothing 1e-7 --cells 48 48 -o wind.vti --picture wind.png
  batten flow examples/data/channel.csv --x x --y y --u u --v v --region 0 3 0 1 --no-slip bottom,top --cells 96 32 -o channel.vti --picture channel.png
  batten flow examples/data/wind.csv --x longitude --y latitude --u u --v v --geographic --smoothing 1e-7 --cells 64 64 -o rotation.vti --streamlines 60 --streamlines-out lines.vtp --picture lines.png)";

}  // namespace batten
