#pragma once
// The indenters: the parameters of a contact, and which of them each indenter uses. Also the pressure distribution of each, integrated over
// the cells of the skin: the fraction of the force on each cell.

#include <array>

#include "core/parameter_override.hpp"
#include "skin/plan/sites.hpp"

namespace corpuscle {

/// Parameters of a contact, in SI units; the meanings are in contact_fields. Positions are in the plane of the skin.
struct ContactParams {
    double radius = 5e-3, edge_radius = 0.5e-3, length = 10e-3, period = 2e-3, ridge = 1e-3, angle = 0, E_star = 100e3;
    double vibration = 0.03, roughness = 0, grain = 0.5e-3;
    double x = 0, y = 0, x1 = 0, y1 = 0, t_start = 0, t_move = 0, speed = 0;
    double tilt = 0, azimuth = 0, friction = 0;
};

inline constexpr ParameterDef<ContactParams> contact_fields[] = {
    {"radius", &ContactParams::radius, "m", 1e-5, 1, "radius of the sphere, of the flat punch, or of the patch in which a grating touches",
     "choice"},
    {"edge_radius", &ContactParams::edge_radius, "m", 1e-6, 0.1, "radius of a rounded edge", "choice"},
    {"length", &ContactParams::length, "m", 1e-5, 1, "length of an edge", "choice"},
    {"period", &ContactParams::period, "m", 1e-5, 0.1, "distance from one ridge of a grating to the next", "choice"},
    {"ridge", &ContactParams::ridge, "m", 1e-6, 0.1, "width of one ridge", "choice"},
    {"angle", &ContactParams::angle, "deg", -360, 360, "angle of an edge or of a grating's ridges from x, counter-clockwise", "choice"},
    {"E_star", &ContactParams::E_star, "Pa", 1e2, 1e9, "reduced modulus E/(1 - nu^2) of the skin under a rigid indenter",
     "choice: the order of magnitude for fingertips, from memory"},
    {"vibration", &ContactParams::vibration, "", 0, 0.5,
     "a sliding grating: amplitude of the vibration at speed / period, as a fraction of the force at a site; harmonic h has 1/h of it",
     "choice"},
    {"roughness", &ContactParams::roughness, "", 0, 0.3,
     "a sliding surface: root mean square of the vibration that its roughness causes, as a fraction of the force at a site",
     "choice; independent of speed, after Greenspon et al. 2019 (doi 10.1101/680322)"},
    {"grain", &ContactParams::grain, "m", 1e-5, 0.1,
     "a rough surface: distance between its bumps along the path; the vibration has frequencies around speed / grain", "choice"},
    {"x", &ContactParams::x, "m", -10, 10,
     "position along x; if neither x nor y is given, the position is the middle of the skin's first region"},
    {"y", &ContactParams::y, "m", -10, 10, "position along y"},
    {"x1", &ContactParams::x1, "m", -10, 10, "position along x at the end of the movement; default: x"},
    {"y1", &ContactParams::y1, "m", -10, 10, "position along y at the end of the movement; default: y"},
    {"t_start", &ContactParams::t_start, "s", 0, 1e6, "start of the movement"},
    {"t_move", &ContactParams::t_move, "s", 0, 1e6, "duration of the movement to x1, y1; alternatively give speed"},
    {"speed", &ContactParams::speed, "m/s", 0, 100,
     "speed of the movement to x1, y1; without x1 and y1, speed of a grating or rough surface under its patch (along x if rough)"},
    {"tilt", &ContactParams::tilt, "deg", 0, 80, "angle of the force from the normal; the stimulus is its normal component", "choice"},
    {"azimuth", &ContactParams::azimuth, "deg", -360, 360,
     "direction of the tilted force along the skin, counter-clockwise from x; 90 is away from the wrist", "choice"},
    {"friction", &ContactParams::friction, "", 0, 10,
     "coefficient of friction of a moving contact, and limit of a tilted force; 0: a movement causes no shear", "choice"},
};

/// One kind of indenter. In the formulas of the descriptions, p is the pressure and F the force. r is the distance from the centre, d that
/// from the centre line. R is the radius of sphere or edge, E* the parameter E_star, a the radius of the contact, b half its width, L its
/// length.
struct Indenter {
    std::string_view name, description, source;
    std::array<std::string_view, 8> parameters;  ///< the parameters that it uses, besides those of the path; "": none
};
inline constexpr Indenter indenters[] = {
    {"flat",
     "a rigid flat punch: p = F/(2 pi a^2) (1 - r^2/a^2)^(-1/2)",
     "Johnson 1985, Contact Mechanics, 3.8",
     {"radius", "roughness", "grain", "E_star"}},
    {"sphere",
     "a rigid sphere (Hertz): a^3 = 3 F R/(4 E*), p = 3F/(2 pi a^2) (1 - r^2/a^2)^(1/2)",
     "Johnson 1985, 4.2",
     {"radius", "E_star", "roughness", "grain"}},
    {"edge",
     "a rounded edge (Hertz's cylinder with a finite length): b^2 = 4 F R/(pi L E*), p = 2F/(pi b L) (1 - d^2/b^2)^(1/2)",
     "Johnson 1985, 4.2(c)",
     {"edge_radius", "length", "angle", "E_star", "roughness", "grain"}},
    {"grating",
     "ridges that carry the force evenly within a round patch, and can move through it",
     "choice",
     {"radius", "period", "ridge", "angle", "vibration"}},
};

/// The indenter with this name. An unknown name is an error.
Result<const Indenter*> find_indenter(std::string_view name);

/// The parameters of a contact from the overrides with target "contact". If they set neither x nor y, the position is the middle of the
/// first region of the sites. A parameter that the indenter does not use is an error.
Result<Applied<ContactParams>> read_contact_params(const Indenter&, std::span<const ParameterOverride>, const Sites&);

/// True for the name of a parameter of position, movement or shear. Every indenter has these.
bool is_path_parameter(std::string_view name);

/// True if the contact moves over the skin, instead of resting.
inline bool is_moving(const ContactParams& p) { return p.x1 != p.x || p.y1 != p.y; }

/// Half the width (along x) and height (along y), in m, of a box that is centred on a contact and encloses it.
struct HalfBox {
    double width, height;
};

/// Describes a contact by one length, its size: the radius of a round contact or patch, half the width of an edge's contact.
class PressureDistribution {
public:
    virtual ~PressureDistribution() = default;
    /// The size of the contact under a force (N), which must be positive; m.
    virtual double size(double force) const = 0;
    virtual HalfBox box(double size) const = 0;  ///< encloses a contact of this size
    /// The normal force (N) whose contact is the part that still sticks after a tangential displacement, divided by the coefficient of
    /// friction, of `displacement` (m). Zero: everything slips. See ContactShear.
    virtual double stuck_force(double /*force*/, double /*displacement*/) const { return 0; }
    /// Writes the force on each cell of a column to `fractions`: as a fraction of the whole force or, for edge and grating, as a number
    /// proportional to it. The cells are [x0, x0 + side] by [y[k], y[k + 1]], in m relative to the contact's centre. `shift`: the distance
    /// that a pattern has moved under the contact, m.
    virtual void column(double size, double shift, double x0, double side, std::span<const double> y, double* fractions) const = 0;
};

/// The pressure distribution of an indenter on cells of this side (m).
std::unique_ptr<PressureDistribution> make_pressure_distribution(const Indenter&, const ContactParams&, double side);

}  // namespace corpuscle
