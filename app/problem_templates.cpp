// SPDX-License-Identifier: MIT
#include <batten/app/problem_templates.h>

#include <array>

namespace batten {
namespace {

struct Template {
  const char* kind;
  const char* text;
};

constexpr const char* poisson = R"TOML(# A membrane, or a steady temperature: -div(k grad u) + c u = q.
problem = "poisson"
x = [0, 1]                # the rectangle
y = [0, 0.6]
cells = [128, 80]         # even numbers that can be halved often are solved fastest
degree = 3                # of the B-splines, 1 to 5

[material]                # each of these is a number, an expression in x and y, or {table = "f.csv"}
k = 1                     # > 0: tension of the membrane, or conductivity
c = 0                     # >= 0: springs, or losses

[load]
q = "sin(pi*x)"           # per area
patches = [{x = [0.2, 0.4], y = [0.1, 0.3], q = 5}]
lines = [{from = [0.6, 0.1], to = [0.9, 0.5], value = 0.5}]   # per length

[supports]                # values prescribed inside
points = [{x = 0.5, y = 0.3, value = 0, radius = 0.02}]       # a peg
# lines = [{from = [0.1, 0.5], to = [0.3, 0.5], value = 0}]

[sides]                   # "free", "symmetry", {value = ...} or {normal = ...}
left = {value = "y^2"}
right = {normal = 1}      # the derivative along the outward normal
bottom = {value = 0}
top = "free"

[solver]
accuracy = 1e-10          # estimated relative error in the energy norm
)TOML";

constexpr const char* plate = R"TOML(# A Kirchhoff plate: D lap^2 w - T lap w + c w = q.
problem = "plate"
x = [0, 1]                # the rectangle
y = [0, 0.6]
cells = [128, 80]         # even numbers that can be halved often are solved fastest
degree = 3                # of the B-splines, 2 to 5

[material]                # each but nu is a number, an expression in x and y, or {table = "f.csv"}
D = 1.0                   # bending rigidity E h^3 / (12 (1 - nu^2)), > 0
nu = 0.3                  # Poisson's ratio
foundation = 0            # c, Winkler's modulus, >= 0
tension = 0               # T, in the plane of the plate, >= 0

[load]                    # in the direction of w
q = "sin(pi*x)"           # per area
points = [{x = 0.5, y = 0.3, value = 1.0}]
lines = [{from = [0.1, 0.1], to = [0.9, 0.1], value = 0.5}]   # per length
patches = [{x = [0.2, 0.4], y = [0.1, 0.3], q = 5}]

[supports]                # values prescribed inside
points = [{x = 0.75, y = 0.45}]
# lines = [{from = [0.5, 0.1], to = [0.5, 0.5], value = 0}]

[sides]                   # "simply-supported", "clamped", "free", "symmetry",
left = "clamped"          # {value = ...}, {normal = ...} or {value = ..., normal = ...}
right = "simply-supported"
bottom = "free"
top = {value = 0, normal = 0.01}

[solver]
accuracy = 1e-10          # estimated relative error in the energy norm
)TOML";

constexpr const char* heat = R"TOML(# Heat in time: density u_t - div(k grad u) + c u = q, from a hot spot.
problem = "poisson"
x = [0, 1]
y = [0, 1]
cells = [64, 64]
degree = 2

[material]
k = "x < 0.5 ? 1 : 10"    # a good conductor to the right

[load]
patches = [{x = [0.7, 0.8], y = [0.4, 0.6], q = 20}]   # a heater

[sides]
left = {value = 0}        # kept cold
right = "free"            # insulated
bottom = "free"
top = "free"

[time]                    # OUT_0000.vti, OUT_0001.vti, ... and OUT.pvd, which ParaView opens
end = 0.2
step = 0.01
initial = "exp(-50*((x-0.3)^2 + (y-0.5)^2))"
density = 1               # heat capacity per area, > 0
)TOML";

constexpr const char* vibration = R"TOML(# The lowest vibrations of a free square plate: D lap^2 w = omega^2 density w.
problem = "plate"
x = [0, 1]
y = [0, 1]
cells = [64, 64]
degree = 3

[material]
D = 1
nu = 0.225

[sides]
left = "free"
right = "free"
bottom = "free"
top = "free"

[modes]                   # OUT_mode1.vti, ... and OUT.pvd; the three rigid motions of a free plate come first
count = 9
density = 1               # mass per area, > 0
)TOML";

constexpr const char* foundation =
    R"TOML(# A plate on an elastic foundation: D lap^2 w + c w = q, here the lithosphere under an island, in SI units.
problem = "plate"
x = [-300e3, 300e3]
y = [-300e3, 300e3]
cells = [128, 128]
degree = 3

[material]
D = "70e9 * 20e3^3 / (12*(1 - 0.25^2))"     # E h^3 / (12 (1 - nu^2)), elastic thickness h = 20 km
nu = 0.25
foundation = "(3300 - 1030) * 9.81"         # buoyancy of the mantle under water

[load]                                      # w is positive downwards, as the load is
q = "(2800 - 1030) * 9.81 * 4000 * exp(-(x^2 + y^2)/(40e3)^2)"

[sides]
left = "free"
right = "free"
bottom = "free"
top = "free"
)TOML";

constexpr const char* stokes =
    R"TOML(# Slow (Stokes) flow: -mu lap v + grad p = f, div v = 0, here through a channel past a stirring force.
problem = "stokes"
x = [0, 2]                # the rectangle
y = [0, 1]
cells = [128, 64]         # even numbers that can be halved often are solved fastest
degree = 3                # of the stream function, 2 to 5

[material]
mu = 1                    # viscosity, a number > 0

[load]
fx = 0                    # force per area: numbers, expressions in x and y, or {table = "f.csv"}
fy = 0
points = [{x = 0.8, y = 0.4, fx = 0, fy = 5}]     # forces

[sides]                   # {u = ..., v = ...}, "wall", "symmetry" or "free"
left = {u = "4*y*(1-y)", v = 0}                   # an inflow; as much must flow out
right = {u = "4*y*(1-y)", v = 0}
bottom = "wall"           # u = v = 0
top = "wall"              # a lid would be {u = 1, v = 0}

[solver]
accuracy = 1e-10          # estimated relative error in the energy norm
)TOML";

constexpr std::array templates = {
    Template{"poisson", poisson},     Template{"plate", plate},           Template{"heat", heat},
    Template{"vibration", vibration}, Template{"foundation", foundation}, Template{"stokes", stokes}};

}  // namespace

const char* problem_template(const std::string& kind) {
  for (const Template& known : templates)
    if (kind == known.kind) return known.text;
  return nullptr;
}

std::string template_kinds() {
  std::string list;
  for (const Template& known : templates) list += (list.empty() ? "" : ", ") + std::string(known.kind);
  return list;
}

const char* const solve_help = R"(
The solution is the B-spline on the grid that minimises the energy of

  poisson   -div(k grad u) + c u = q            membranes, heat, diffusion
  plate     D lap^2 w - T lap w + c w = q       Kirchhoff plates
  stokes    -mu lap v + grad p = f, div v = 0   slow flow, v = (psi_y, -psi_x)

under the conditions of the sides and supports. With [modes] in the file it is
the lowest free vibrations, with [time] the motion from an initial state. A
slow flow is a result as batten flow writes it.
docs/solve.md explains every key; a template is the quickest start:

  batten solve --template plate > my.toml

Lengths, loads and times are in your own units, which must fit together. Loads
act in the direction of positive u or w.

Examples:
  batten solve examples/data/clamped_plate.toml -o plate.vti --picture plate.png --report plate.json
  batten solve examples/data/lid_cavity.toml -o cavity.vti --picture cavity.png --report cavity.json)";

}  // namespace batten
