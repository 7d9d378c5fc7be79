#pragma once
// The measures of a contact: one row each, and which of them an indenter has.

#include <array>

#include "signal/settings.hpp"
#include "skin/sites.hpp"

namespace corpuscle {

/// What a contact is given, SI; lengths of the skin's plane.
struct ContactParams {
    double radius = 5e-3, edge_radius = 0.5e-3, length = 10e-3, period = 2e-3, ridge = 1e-3, angle = 0, E_star = 100e3;
    double x = 0, y = 0, x1 = 0, y1 = 0, t_start = 0, t_move = 0, speed = 0;
};

inline constexpr Field<ContactParams> contact_fields[] = {
    {"radius", &ContactParams::radius, "m", 1e-5, 1, "of the sphere, of the flat punch, of the patch in which a grating touches", "choice"},
    {"edge_radius", &ContactParams::edge_radius, "m", 1e-6, 0.1, "how an edge is rounded", "choice"},
    {"length", &ContactParams::length, "m", 1e-5, 1, "of an edge", "choice"},
    {"period", &ContactParams::period, "m", 1e-5, 0.1, "from one ridge of a grating to the next", "choice"},
    {"ridge", &ContactParams::ridge, "m", 1e-6, 0.1, "width of one ridge", "choice"},
    {"angle", &ContactParams::angle, "", -360, 360, "degrees: an edge lies, and a grating's ridges go, so far from x, counter-clockwise",
     "choice"},
    {"E_star", &ContactParams::E_star, "Pa", 1e2, 1e9, "reduced modulus E/(1 - nu^2) of the skin under a rigid indenter",
     "choice: of the order told of fingertips, from memory"},
    {"x", &ContactParams::x, "m", -10, 10, "where it presses; unless x or y is said, in the middle of the skin's first region"},
    {"y", &ContactParams::y, "m", -10, 10, "where it presses"},
    {"x1", &ContactParams::x1, "m", -10, 10, "where it is moved to; x unless said"},
    {"y1", &ContactParams::y1, "m", -10, 10, "where it is moved to; y unless said"},
    {"t_start", &ContactParams::t_start, "s", 0, 1e6, "when it begins to move"},
    {"t_move", &ContactParams::t_move, "s", 0, 1e6, "how long it takes to x1, y1; or say a speed"},
    {"speed", &ContactParams::speed, "m/s", 0, 100,
     "how fast it is moved to x1, y1; without these, how fast a grating passes under its patch"},
};

/// One thing that can press.
struct Indenter {
    std::string_view name, sentence, source;
    std::array<std::string_view, 4> measures;  ///< its own, besides the path
};
inline constexpr Indenter indenters[] = {
    {"flat", "a rigid flat punch: p = F/(2 pi a^2) (1 - r^2/a^2)^(-1/2)", "Johnson 1985, Contact Mechanics, 3.8", {"radius"}},
    {"sphere",
     "a rigid sphere (Hertz): a^3 = 3 F R/(4 E*), p = 3F/(2 pi a^2) (1 - r^2/a^2)^(1/2)",
     "Johnson 1985, 4.2",
     {"radius", "E_star"}},
    {"edge",
     "a rounded edge (Hertz's cylinder, of a length): b^2 = 4 F R/(pi L E*), p = 2F/(pi b L) (1 - d^2/b^2)^(1/2)",
     "Johnson 1985, 4.2(c)",
     {"edge_radius", "length", "angle", "E_star"}},
    {"grating",
     "ridges that share the force evenly within a round patch; they pass under it",
     "choice",
     {"radius", "period", "ridge", "angle"}},
};

/// The indenter of this name; refuses any other.
Result<const Indenter*> indenter_named(std::string_view name);

/// A contact's measures as asked for; those that neither wish nor row gives come from the sites.
Result<ContactParams> contact_params(const Indenter&, std::span<const Wish>, const Sites&);

/// Of where a contact is and goes; every indenter has these.
bool is_path_measure(std::string_view name);

/// Whether it is moved over the skin.
inline bool moves(const ContactParams& p) { return p.x1 != p.x || p.y1 != p.y; }

}  // namespace corpuscle
