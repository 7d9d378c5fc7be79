#pragma once
// A netlist prepared for a study: an embedded netlist with settings and with the study's own directives.

#include "circuit/run_directives.hpp"
#include "study/study_curve.hpp"

namespace corpuscle {

struct StudyNetlist {
    /// "bias" means circuits/bias.cir. A text of several lines is the netlist itself; its first line is the title. It includes 'parts/...'
    /// and '../process/tsmc180.lib' as the netlists in circuits/ do.
    std::string circuit;
    std::vector<std::string> settings = {};  ///< "i_bias=100n", "temp=85", "corner=ss", "m1a.w=2um": as for --set
    /// Lines that replace the netlist's analyses, measures, .print, .save, .step, .mc and expectations; empty: the netlist keeps them.
    std::string directives = {};
    /// Parameters of the model card that are set in every model: `ideal_mirrors`.
    circuit::Values model_parameters = {};
};

/// Disables channel-length modulation and velocity saturation, so that mirror ratios are exact.
inline const circuit::Values ideal_mirrors = {{"ve", 1e30}, {"zetal", 0}};

/// Results of one variant of a netlist.
struct NetlistResult {
    std::string label;  ///< of the variant, as in the results of .step and .mc
    std::shared_ptr<const circuit::Circuit> circuit;
    circuit::RunOutcome outcome;

    /// A curve, named as in .save and .print, of the first analysis of this kind ("dc"), over its swept quantity; empty if there is none.
    StudyCurve curve(std::string_view analysis, const std::string& y) const;
    /// One curve over the values of another.
    StudyCurve curve(std::string_view analysis, const std::string& y, const std::string& over) const;
    /// The value of a measurement, or one that an analysis prints; NaN if there is none.
    double number(std::string_view name) const;
    /// v(q), i(vis) at the operating point (.op).
    double operating_point(const std::string& name) const;
    /// A derivative at the operating point, from .tf with these arguments: derivative("i(vd)", "vg") is dI/dV_G; NaN if it was not
    /// requested.
    double derivative(std::string_view output, std::string_view source) const;
    /// A value that .op prints for a nominal device: operating_info("x1.m1", "i_f"), also i_d i_r g_mg g_ms g_md g_mb v_t i_bs i_bd; NaN if
    /// there is none.
    double operating_info(std::string_view device, std::string_view name) const;
};

Result<NetlistResult> run_study_netlist(const StudyNetlist&);
/// All variants of .step and .mc. Fails if any variant does not converge.
Result<std::vector<NetlistResult>> run_study_variants(const StudyNetlist&);

/// The text of an embedded file ("circuits/parts/transducer.inc") with every occurrence of each first text replaced by the second. Fails if
/// a text does not occur.
Result<std::string> substitute_in_embedded_text(const std::string& file, const std::vector<std::pair<std::string, std::string>>& changes);

/// The elaborated circuit, to read transistor sizes and device counts.
Result<std::shared_ptr<const circuit::Circuit>> elaborate_study_netlist(const StudyNetlist&);

}  // namespace corpuscle
