// A case as plain data: what the case reader fills in and the solver builds a scene from. SI units.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "math/expression.hpp"
#include "math/vec3.hpp"
#include "physics/eos.hpp"
#include "physics/hyperelastic_material.hpp"

namespace cobasis {

/// axisymmetric: x along the axis, y >= 0 the distance from it; no velocity around it.
enum class Geometry { plane, axisymmetric, space };
constexpr const char* name_of(Geometry geometry) {
  return geometry == Geometry::plane ? "plane" : geometry == Geometry::axisymmetric ? "axisymmetric" : "space";
}
/// Between two solids; others slide.
struct Contact {
  enum Kind { sliding, adherence, friction };
  Kind kind = sliding;
  double coefficient = 0;  ///< Coulomb's, of friction

  Contact(Kind k = sliding, double f = 0) : kind(k), coefficient(f) {}  // NOLINT: a kind without numbers is a contact
  bool operator==(const Contact&) const = default;
};

/// Of two phases that are mixed, see relax. 0: none of it; infinity: at once.
struct Relaxation {
  double velocity = 0;  ///< drag per difference of velocities and product of volume fractions [kg/(m^3 s)]
  double pressure = 0;  ///< rate of the volume fraction, likewise [1/(Pa s)]

  bool operator==(const Relaxation&) const = default;
};

struct PhaseSetup {
  std::string name;
  Eos eos;                                      ///< unused by a void
  std::optional<HyperelasticMaterial> elastic;  ///< absent: a fluid
  std::optional<double> void_pressure;          ///< present: a void at this pressure [Pa], no state of its own
  std::optional<double> density;                ///< default initial density [kg/m^3] (the material's rho0)

  bool is_void() const { return void_pressure.has_value(); }
  bool is_solid() const { return elastic.has_value(); }
};

/// Initial or inflow state of one phase.
struct PhaseState {
  std::optional<Expression> density;                            ///< [kg/m^3]; default: of the cobasis, or the phase's
  Expression pressure;                                          ///< p, not -sigma [Pa]
  std::array<Expression, 3> velocity;                           ///< [m/s]
  std::optional<std::array<std::array<double, 3>, 3>> cobasis;  ///< rows: x, y, z components of (e^1, e^2, e^3)
};

/// What fills a region or enters through a boundary. Both vectors: one entry per phase, in order.
struct Filling {
  std::vector<double> alpha;       ///< sums to 1; 0: absent
  std::vector<PhaseState> states;  ///< of absent phases too (used with alpha_min traces)
};

struct Everywhere {};
struct HalfSpace {
  Point point, normal;
};  ///< the side the normal points to
struct Box {
  Point low, high;
};
struct Sphere {
  Point center;
  double radius;
};  ///< a disc in a plane
struct Cylinder {
  Point from, to;
  double radius;
};  ///< finite, axis from -> to (space only)
struct PhysicalGroup {
  std::string name;
};  ///< cells of a physical group of the mesh
struct Inside {
  Expression condition;
};  ///< where the condition is true
using Shape = std::variant<Everywhere, HalfSpace, Box, Sphere, Cylinder, PhysicalGroup, Inside>;

struct RegionSetup {
  Shape shape;
  Filling filling;
  std::string where;  ///< file:line, for messages
};

/// Frictionless. At rest it mirrors normal velocity and cobasis; of its velocity [m/s] the normal part counts.
struct Wall {
  std::optional<std::array<Expression, 3>> velocity;
};
/// Solids are bonded to it; before fluids, which have no viscosity, it is a frictionless wall.
struct NoSlip {
  std::array<Expression, 3> velocity;  ///< [m/s]
};
struct Symmetry {};        ///< the same mirror; bodies and interfaces go on beyond
struct AxisOfSymmetry {};  ///< y = 0 of an axisymmetric scene
struct Transmissive {};    ///< zero gradient
struct Outlet {
  double pressure = 0;
};  ///< an opening to this pressure [Pa]; zero gradient where the flow is supersonic
struct Inflow {
  Filling filling;
};
struct Periodic {
  std::string with;
};  ///< the partner group
using Boundary = std::variant<Wall, NoSlip, Symmetry, AxisOfSymmetry, Transmissive, Outlet, Inflow, Periodic>;

struct BoundarySetup {
  std::string group;  ///< physical group, or "*": every group not named
  Boundary boundary;
  std::string where;  ///< file:line
};

struct OutputSetup {
  std::string directory;        ///< resolved path
  std::string where;            ///< file:line of the directory, or the option that names it
  std::optional<double> every;  ///< [s]; exactly one of every, count is set
  std::optional<int> count;
  std::vector<std::string> fields;  ///< of: alpha density velocity pressure stress cobasis energy (mixture follows)
  bool float64 = false;
  std::vector<int> only;  ///< phases: only cells with more than `only_above` of one of them; empty: all cells
  double only_above = 0;
};

struct LineSetup {
  std::string name;
  Point from, to;
  int points = 2;
};
struct ProbeSetup {
  std::string name;
  Point at;
};
/// Fields where a plane cuts the mesh.
struct SliceSetup {
  std::string name;
  Point point, normal;
  std::optional<double> every;  ///< [s]; exactly one of every, count is set
  std::optional<int> count;
  std::string where;  ///< file:line
};
enum class Axis { x, y, z, radial };
struct Extent {
  int phase;
  double alpha;
  Axis axis;
  std::optional<Box> box = {};
  std::string where = {};  ///< file:line
};                         ///< farthest coordinate, in the box, where interpolated alpha reaches the value
struct Quantile {
  int phase;
  double fraction;
  Axis axis;
};  ///< coordinate below which the fraction of the phase's volume lies
struct Mean {
  std::string field;  ///< a column as in tables: pressure.copper, stress.xx
  Shape region;       ///< Everywhere or Box
  std::string where;  ///< file:line
};                    ///< of a field over a region, by volume; of a phase's field by the phase's volume
struct IntegralSetup {
  std::string name;
  std::variant<Extent, Quantile, Mean> what;
  std::string unit = "m";
};

/// sharp: planes that neighbouring cells share; compressed: planes, but no more of a face than a multiple of the volume
/// fraction; diffuse: mixtures.
enum class InterfaceTreatment { sharp, compressed, diffuse };

/// The numerical method.
struct Scheme {
  int order = 2;  ///< in space and time
  InterfaceTreatment interface = InterfaceTreatment::diffuse;
  bool limited = true;  ///< slopes of order 2
  bool low_mach = false;
};

/// Steps, or else minutes of the wall clock.
struct CheckpointEvery {
  std::optional<std::int64_t> steps;
  double minutes = 10;
};

struct Setup {
  std::string case_file;
  std::map<std::string, std::string> keys;  ///< all that are given, dotted, and their values as text
  std::string title;
  std::string mesh_file;  ///< resolved path
  std::map<std::string, double> mesh_parameters;
  std::optional<Geometry> scene;  ///< default: space for a mesh with volume cells, else plane
  double end_time = 0;            ///< [s]
  double cfl = 0.8;
  Scheme scheme;
  Point gravity{0, 0, 0};  ///< [m/s^2]
  double alpha_min = 0;    ///< 0: absent phases are absent; > 0: traces everywhere
  std::optional<std::int64_t> max_steps;
  std::optional<CheckpointEvery> checkpoint_every;
  std::vector<PhaseSetup> phases;
  Contact default_contact;
  std::map<std::pair<int, int>, Contact> contacts;        ///< by phase indices, smaller first
  std::map<std::pair<int, int>, Relaxation> relaxations;  ///< likewise
  std::vector<RegionSetup> regions;                       ///< painted in order
  std::vector<BoundarySetup> boundaries;
  OutputSetup output;
  std::optional<std::int64_t> history_every;  ///< steps between rows; default one row per 0.1 % of the run
  std::vector<LineSetup> lines;
  std::vector<ProbeSetup> probes;
  std::vector<SliceSetup> slices;
  std::vector<IntegralSetup> integrals;

  Contact contact(int l, int m) const {
    const auto found = contacts.find(l < m ? std::pair(l, m) : std::pair(m, l));
    return found == contacts.end() ? default_contact : found->second;
  }
};

}  // namespace cobasis
