#pragma once
// What .step and .mc make of one netlist: the same circuit with other values, one after another.

#include <memory>
#include <optional>

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

struct Variant {
    std::string label;                       ///< "r=1000", "temp=85", "mc=17"; several with blanks between; "" if there is only one
    std::shared_ptr<const Circuit> circuit;  ///< the same as the last one's, if only the draw differs
    std::optional<Draw> draw;
};

/// What a .mc line says of the chips that it asks for.
struct Chips {
    double count = 0;
    std::uint64_t seed = 0;
    bool process = true, mismatch = true;
    std::uint64_t first = 0;  ///< the number of the first

    Draw draw(std::uint64_t chip) const;  ///< 0: of the first, and so on
};
Result<Chips> chips_of(const Command&);
/// The chip that a circuit is, if its mismatch is set.
std::optional<Draw> own_draw(const Circuit&);

/// .step param NAME FROM TO STEP | .step param NAME list A B ... | .step dec|oct param NAME FROM TO POINTS; NAME may be temp (without
/// param). Several .step lines: every value of the first with every of the second. .mc COUNT [seed=S] [process=0] [mismatch=0]: each
/// transistor draws its own delvto and mulu0, each chip its process, after the card's deviations (avt, ais, svt0, sis).
class Variants {
public:
    /// What one .step line gives.
    struct Axis {
        std::string name;
        std::vector<double> values;
    };

private:
    Netlist netlist_;
    std::vector<Axis> axes_;
    Chips chips_;
    std::shared_ptr<const Circuit> plain_;
    struct Stepped {
        std::size_t number;
        std::string label;
        std::shared_ptr<const Circuit> circuit;
    };
    std::optional<Stepped> last_;

    Result<void> step(std::size_t number);

public:
    static Result<Variants> of(const Netlist&);
    std::size_t count() const;
    const std::vector<Axis>& axes() const { return axes_; }
    const Chips& chips() const { return chips_; }  ///< count 0: no .mc
    bool draws() const { return chips_.count > 0; }
    /// Quick where numbers follow each other: draws run fastest.
    Result<Variant> at(std::size_t number);
};

}  // namespace corpuscle::circuit
