#pragma once
// A device says its currents, charges and slopes, once; operating points, sweeps, spectra and noise are uses of them.

#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/netlist.hpp"
#include "signal/error.hpp"

namespace corpuscle::circuit {

class Trace;

/// Under what a device is looked at.
struct Instant {
    double time = 0;
    double sources = 1;   ///< what part of their value sources give: less than 1 on the way to an operating point
    double gmin = 0;      ///< S, beside every junction
    bool charges = true;  ///< false: nobody asks for charges and capacitances
};

/// What a device adds: for each of its unknowns (terminals, then its own) the current out of the node into the device and the charge that
/// follows it, A and C; of an unknown of its own that is no node, the two sides of its equation. Slopes row by row.
struct Stamp {
    std::span<double> f, q, df, dq;
    double& slope(std::size_t row, std::size_t column) const { return df[row * f.size() + column]; }
    double& capacitance(std::size_t row, std::size_t column) const { return dq[row * f.size() + column]; }
};

/// A noise current between two unknowns of a device: its spectral density, A^2/Hz, is white + flicker / f.
struct NoiseSource {
    std::string_view what;  ///< "thermal", "shot", "flicker" ...
    std::size_t from, to;   ///< of the device's unknowns
    double white = 0, flicker = 0;
};

/// One line of the table of an operating point.
struct Reading {
    std::string_view name, unit;
    double value;
};

/// What makes one chip differ from the next, drawn for (seed, chip).
struct Draw {
    std::uint64_t seed = 0, chip = 0;
    bool mismatch = true;    ///< whether each device draws its own
    double process[4] = {};  ///< what all share, as normal deviates: V_T0 of NMOS and PMOS, then I_SQ of both
};

class Device {
public:
    std::string name;
    Place place;
    std::vector<int> unknowns;  ///< in the system; -1: ground

    virtual ~Device() = default;
    /// Adds to a stamp that is zero. v: of its unknowns.
    virtual void eval(std::span<const double> v, const Instant&, const Stamp&) const = 0;
    virtual bool linear() const { return true; }
    /// Whether its currents may jump from one v to the next, as those of a formula.
    virtual bool jumps() const { return false; }

    /// How many numbers it keeps between the steps of an iteration, and what may become of a step: v is changed to where it is to be
    /// looked at, if it would go too far at once. Returns whether it was.
    virtual std::size_t memory() const { return 0; }
    virtual bool limit(std::span<double>, std::span<double>) const { return false; }

    /// Of a source: the value that a sweep gives it, and what drives .ac.
    virtual bool set(double) { return false; }
    virtual std::optional<double> setting() const { return {}; }
    virtual void drive(std::span<std::complex<double>>) const {}

    /// From now on a source goes its course in time, in an analysis of this step and end, s; 0: it stands as it did.
    virtual void go(double, double) {}
    /// From now on a source that carries force takes it from this trace; null: 0 N. False: it carries none.
    virtual bool hear(const Trace*) { return false; }
    /// The first time after t at which it bends or jumps, s.
    virtual double next_corner(double) const { return std::numeric_limits<double>::infinity(); }
    /// The longest step, s, that does not overlook what it does between its corners.
    virtual double pace() const { return std::numeric_limits<double>::infinity(); }
    /// Of a linear device: whether its currents change with time at all.
    virtual bool varies() const { return false; }

    /// Its own part of a draw, as the device of this number among those that draw; null: as designed. False: it never differs.
    virtual bool draw(const Draw*, std::uint32_t) { return false; }

    /// At the operating point; v as in eval.
    virtual std::vector<NoiseSource> noise(std::span<const double>) const { return {}; }
    virtual std::vector<Reading> readings(std::span<const double>) const { return {}; }
    virtual std::string state(std::span<const double>) const { return {}; }  ///< "saturation", "weak" ...
};

/// Where devices of one kind are looked at together: rows of `room` numbers, one a device, on 64 bytes; else as in Stamp.
struct BankStamp {
    std::size_t room;
    const double* v;
    double *f, *df;
    double* most;     ///< of each f, what its last digit is of; null: not asked
    double *q, *dq;   ///< null: not asked
    double rate = 0;  ///< 1/s: f and df are wanted with rate times q and dq added
};

/// Devices of one kind, side by side on lanes; `room` is a multiple of 8, and the last device fills what is over.
class Bank {
public:
    virtual ~Bank() = default;
    virtual void take(std::span<const Device* const>) = 0;  ///< their numbers, at first and whenever they have changed
    virtual void eval(const Instant&, const BankStamp&) const = 0;
    /// q along its slopes: q += dq dv.
    virtual void follow(std::size_t room, const double* dv, const double* dq, double* q) const = 0;
};

/// Where a device gets its unknowns when it is made.
class Setup {
public:
    virtual ~Setup() = default;
    virtual int node(int number) const = 0;                ///< the unknown of a node
    virtual int branch(int element) const = 0;             ///< of the current through an element; -1: it has none
    virtual int own(std::string_view name) = 0;            ///< a new one: "x1.d1#anode"
    virtual double temperature(const Element&) const = 0;  ///< K
    virtual const Circuit& circuit() const = 0;
};

}  // namespace corpuscle::circuit
