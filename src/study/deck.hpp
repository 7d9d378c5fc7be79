#pragma once
// A netlist as a study runs it: one that the program carries, with what is set of it, under orders of the study's own.

#include "circuit/run.hpp"
#include "study/line.hpp"

namespace corpuscle {

struct Deck {
    /// "bias": circuits/bias.cir; or the netlist itself, in several lines of which the first is its title, which includes 'parts/...' and
    /// '../process/tsmc180.lib' as those in circuits/ do.
    std::string circuit;
    std::vector<std::string> settings = {};  ///< "i_bias=100n", "temp=85", "corner=ss", "m1a.w=2um": as --set has them
    /// Lines put in place of the netlist's analyses, measures, .print, .save, .step, .mc and expectations; empty: its own.
    std::string orders = {};
    /// Numbers of the card that are set in every model: `ideal_mirrors`.
    circuit::Values of_models = {};
};

/// Without length modulation and velocity saturation mirrors divide by their ratios.
inline const circuit::Values ideal_mirrors = {{"ve", 1e30}, {"zetal", 0}};

/// What was found of one circuit.
struct Found {
    std::string label;  ///< of which variant, as .step and .mc name them
    std::shared_ptr<const circuit::Circuit> circuit;
    circuit::RunOutcome outcome;

    /// A curve, named as in .save and .print, of the first analysis of this word ("dc"), over what that sweeps; empty: there is none.
    Line line(std::string_view analysis, const std::string& y) const;
    /// One curve over another.
    Line line(std::string_view analysis, const std::string& y, const std::string& over) const;
    /// A measure's number, or one that an analysis prints; NaN: there is none.
    double number(std::string_view name) const;
    /// v(q), i(vis) at the operating point (.op).
    double at_rest(const std::string& name) const;
    /// A slope at the operating point, as .tf with these words found it: by("i(vd)", "vg") is dI/dV_G; NaN: it was not asked.
    double by(std::string_view output, std::string_view source) const;
    /// What .op prints of a device as designed: reading("x1.m1", "i_f"), also i_d i_r g_mg g_ms g_md g_mb v_t i_bs i_bd; NaN: there is
    /// none.
    double reading(std::string_view device, std::string_view name) const;
};

Result<Found> found_in(const Deck&);
/// All variants of .step and .mc. None is left out: one that does not converge is the error.
Result<std::vector<Found>> all_found_in(const Deck&);

/// The text of a file that the program carries ("circuits/parts/transducer.inc"), with each of these pieces replaced wherever it stands;
/// refused where one does not stand.
Result<std::string> changed_text(const std::string& file, const std::vector<std::pair<std::string, std::string>>& changes);

/// The elaborated circuit: its sizes and counts.
Result<std::shared_ptr<const circuit::Circuit>> circuit_of(const Deck&);

}  // namespace corpuscle
