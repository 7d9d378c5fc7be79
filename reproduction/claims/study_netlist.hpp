#pragma once
// A netlist prepared for a study: an embedded netlist, or a text, with overrides and with the study's own directives. Also its results.

#include "circuit/run_directives.hpp"
#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

struct StudyNetlist {
    /// A name such as "bias" means the embedded circuits/bias.cir. A text of several lines is the netlist itself, with a title as its first
    /// line; its .include paths are relative to circuits/.
    std::string circuit;
    std::vector<std::string> settings = {};  ///< overrides as for --set: "i_bias=100n", "temp=85", "corner=ss", "m1a.w=2um"
    /// Lines that replace the netlist's analyses, measures, .print, .save, .step, .mc and expectations; empty: the netlist keeps them.
    std::string directives = {};
    /// Parameters of the model card that are set in every model, such as ideal_mirrors.
    circuit::Values model_parameters = {};
};

/// Model parameters that disable channel-length modulation (ve) and velocity saturation (zetal), so that mirror ratios are exact.
inline const circuit::Values ideal_mirrors = {{"ve", 1e30}, {"zetal", 0}};

/// Results of one variant of a netlist: one step of .step, one chip of .mc, or the only variant.
struct NetlistResult {
    std::string label;  ///< of the variant, as in the results of .step and .mc
    std::shared_ptr<const circuit::Circuit> circuit;
    circuit::RunOutcome outcome;

    /// The curve y, named as in .save and .print, of the first analysis of this kind ("dc"), over the swept quantity of the analysis. Empty
    /// if there is no such analysis or curve.
    StudyCurve curve(std::string_view analysis, const std::string& y) const;
    /// The same, but over the values of another curve of the analysis.
    StudyCurve curve(std::string_view analysis, const std::string& y, const std::string& over) const;
    /// The value of a measurement (.meas), or of a number that an analysis prints, by name; NaN if there is none of this name.
    double number(std::string_view name) const;
    /// A voltage or current at the operating point, such as "v(q)" or "i(vis)"; NaN without .op or without this quantity.
    double operating_point(const std::string& name) const;
    /// A derivative at the operating point, from .tf with these arguments: derivative("i(vd)", "vg") is dI/dV_G. NaN if
    /// there is no such .tf.
    double derivative(std::string_view output, std::string_view source) const;
    /// A value that .op prints for a device, such as operating_info("x1.m1", "i_f"). The names for a transistor are i_d i_f i_r g_mg g_ms
    /// g_md g_mb v_t i_bs i_bd. It is computed without mismatch. NaN if there is no such device or value.
    double operating_info(std::string_view device, std::string_view name) const;
};

/// Runs all variants and returns the first, usually the only one. Fails if any variant does not converge.
Result<NetlistResult> run_study_netlist(const StudyNetlist&);
/// Runs all variants of .step and .mc. Fails if any variant does not converge.
Result<std::vector<NetlistResult>> run_study_variants(const StudyNetlist&);

/// The text of an embedded file ("circuits/parts/transducer.inc") with replacements. `changes`: pairs of a text and the
/// text that replaces it wherever it occurs. Fails if a text does not occur.
Result<std::string> substitute_in_embedded_text(const std::string& file, const std::vector<std::pair<std::string, std::string>>& changes);

/// The elaborated circuit, to read transistor sizes and device counts.
Result<std::shared_ptr<const circuit::Circuit>> elaborate_study_netlist(const StudyNetlist&);

}  // namespace corpuscle
