#pragma once
// .save: which curves are kept.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

/// A voltage, or a current: through a voltage source, which is an unknown; or into a device's first terminal (drain, anode), which follows
/// from the voltages about it: at rest, so without what charges take. Of a transistor that is its channel and its drain's junction.
struct Saved {
    std::string name;  ///< "v(out)", "v(a,b)", "i(v1)", "i(x1.m1)"
    Wanted of = {};
    int device = -1;  ///< in System::devices(), if it is a device's own current

    bool is_voltage() const { return name[0] == 'v'; }
    /// `value(unknown)` gives each unknown's; -1 is ground.
    template <class Value>
    double seen(const System& system, Value&& value) const {
        if (device < 0) return value(of.plus) - value(of.minus);
        const auto& d = *system.devices()[static_cast<std::size_t>(device)];
        std::vector<double> v;
        for (const int u : d.unknowns) v.push_back(value(u));
        return current_into(d, v);
    }

private:
    static double current_into(const Device&, std::span<const double> v);
};

/// Whether an element that is no voltage source has a current that its own voltages alone decide.
inline bool has_own_current(const Element& e) { return e.letter == 'm' || e.letter == 'd' || e.letter == 'r'; }

/// What .save names; "out" is v(out). Empty: everything, as it is without .save, or with "all".
Result<std::vector<Saved>> saved_of(const System&);

/// Whether a word of .probe asks for what is not told here: the current of a capacitor, vd(r2), p(x1).
bool is_left_out(const Circuit&, const Command& probe, std::string_view word);

}  // namespace corpuscle::circuit
