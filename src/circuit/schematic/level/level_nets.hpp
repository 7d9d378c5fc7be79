#pragma once
// Rails, roles and potentials of the nets of a level. Used inside circuit/schematic only.

#include "circuit/schematic/level/level.hpp"

namespace corpuscle::circuit::schematic {

/// Sets the kind of each net: which nets are supplies and grounds.
void find_rails(Level&);
/// Gives the channel of a transistor that carries no current the role of a bulk: its source is joined with nothing but bulks.
void find_idle_channels(Level&);
/// Removes the bulk pins of transistors whose bulk is at the rail: ground for N, the only supply for P.
void hide_bulks_at_rails(Level&);
/// Sets the roles of the ports from the pins inside.
void find_port_roles(Level&);
/// Estimates the potential of each net.
void estimate_potentials(Level&);

inline bool is_transistor(Symbol s) { return s == Symbol::nmos || s == Symbol::pmos || s == Symbol::npn || s == Symbol::pnp; }
inline bool is_mos(Symbol s) { return s == Symbol::nmos || s == Symbol::pmos; }
inline bool is_p_type(Symbol s) { return s == Symbol::pmos || s == Symbol::pnp; }
inline const Net& net_of(const Level& level, const Pin& pin) { return level.nets[static_cast<std::size_t>(pin.net)]; }
inline bool is_rail(const Level& level, const Pin& pin) { return net_of(level, pin).kind != NetKind::signal; }

}  // namespace corpuscle::circuit::schematic
