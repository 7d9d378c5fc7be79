#pragma once
// A SPICE netlist: its parsed statements, and the flat circuit that results once its parameters have values.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "circuit/netlist/expression.hpp"
#include "signal/error.hpp"

namespace corpuscle::circuit {

/// Evaluated name=value pairs; names in small letters.
using Values = std::map<std::string, double, std::less<>>;

/// The specification of a source: DC value, AC stimulus and time waveform.
struct Waveform {
    enum class Shape { none, pulse, sine, exponential, piecewise_linear, force } shape = Shape::none;
    double dc = 0;
    bool has_dc = false;
    double ac_magnitude = 0, ac_phase = 0;  ///< phase in degrees
    std::vector<double> numbers;            ///< the arguments of PULSE, SIN or EXP; for PWL t1 v1 t2 v2 ...
};

/// An element with all its values evaluated.
struct Element {
    std::string name;        ///< in small letters, with the path of its subcircuit: "x1.xinv.m1"
    char letter = 0;         ///< r c l v i e f g h b d m
    std::vector<int> nodes;  ///< indices in Circuit::nodes, in netlist order; for E and G including the controlling nodes
    SourceLocation location;
    int model = -1;                        ///< index in Circuit::models; -1 if none
    double value = 0;                      ///< for R C L in ohm, farad, henry; for E F G H the gain
    Values values;                         ///< all values given by name: w, l, m, stack, delvto, ic, tc1 ...
    Waveform waveform;                     ///< for V and I
    std::optional<Expression> expression;  ///< for B (v= or i=), C (q=), E and G (value=)
    bool expression_is_voltage = false;    ///< for B: true for v=, false for i=
    std::string control_source;            ///< for F and H: the controlling voltage source, with its path
};

struct Model {
    std::string name, type;  ///< types are d, nmos, pmos, r, c, ...; the name of a local model has the path of its subcircuit
    SourceLocation location;
    Values values;
    std::map<std::string, std::string, std::less<>> texts;  ///< values that are not numbers: text in double quotes, and version=3.3.0
};

/// A directive of the circuit: .op, .dc, .ac, .meas, .print, .save, .expect, ... Words are in small letters except for quoted ones, and
/// expressions in braces are replaced by their values.
struct Directive {
    std::string name;  ///< "op", "dc", ... without the dot
    std::vector<std::string> words;
    std::vector<int> columns;  ///< of each word
    SourceLocation location;
};

/// A flat netlist: subcircuits are expanded and parameters are evaluated.
struct Circuit {
    std::string title, file;
    std::vector<std::string> nodes{"0"};  ///< 0 is ground ("0", "gnd")
    std::vector<Element> elements;
    std::vector<Model> models;
    std::vector<Directive> directives;
    Values options;                                                ///< from .options; a flag is 1
    std::map<std::string, std::string, std::less<>> option_words;  ///< options whose value is a word: method=gear
    double temperature = 27;                                       ///< C
    std::vector<std::pair<int, double>> ic, nodesets;              ///< node, V
    std::vector<Error> warnings;                                   ///< warnings, such as "1F is 1 femtofarad"
    Values parameters;                                             ///< .param lines of the top level
    std::optional<std::uint64_t> mismatch_seed;                    ///< seed of the mismatch sample; nothing for the nominal circuit
    std::uint64_t chip = 0;                                        ///< number of the chip for this seed; copies are the following chips

    std::unordered_map<std::string, int> node_numbers, element_numbers;  ///< indices by name, filled by elaborate()

    int find_node(std::string_view name) const;     ///< its index; -1 if there is none of this name
    int find_element(std::string_view name) const;  ///< its index; -1 if there is none of this name
};

/// Overrides of the values in a netlist.
struct ResolvedOverrides {
    std::string corner;                                  ///< section to read from libraries; "" means the sections that the netlist names
    Values parameters;                                   ///< new values for .param lines of the top level
    std::map<std::string, Values, std::less<>> numbers;  ///< values of elements, by full path; the name "" is the value of R C L V I ...
    std::optional<double> temperature;                   ///< C
    std::optional<std::uint64_t> mismatch_seed;          ///< seed of the mismatch sample; if set, .mc is ignored
    std::uint64_t chip = 0;                              ///< number of the chip for this seed
    std::vector<std::string> saved;                      ///< additional names for .save
    bool changes_values() const { return !corner.empty() || !parameters.empty() || !numbers.empty() || temperature || mismatch_seed; }
    bool replaces_saved = false;  ///< `saved` replaces every .save
};

/// The statements of a netlist and of all files that it includes.
class Netlist {
    struct Impl;
    std::shared_ptr<const Impl> impl_;
    std::shared_ptr<const ResolvedOverrides> overrides_;

public:
    /// Returns the text of an included file. The path is resolved against the including file.
    using FileOpener = std::function<Result<std::string>(const std::string& path)>;
    /// `corner` replaces the section of each line `.lib 'file' section` whose file has a section of this name. It is an error if no file
    /// has one.
    static Result<Netlist> parse(std::string text, std::string file, const FileOpener& open, const std::string& corner = "");
    /// Parses the netlist in a file.
    static Result<Netlist> read(const std::string& path, const std::string& corner = "");

    /// The same netlist with overrides. Their corner has no effect here, because parse() applies it.
    Netlist with_overrides(ResolvedOverrides) const;
    const ResolvedOverrides& overrides() const;
    /// A parameter that a .param line of the top level defines.
    struct Parameter {
        std::string text;  ///< as written in the netlist: "2*c_u"
        bool is_defined_in_netlist;       ///< defined in the netlist or an included file, not in a library section
    };
    /// All parameters of the top level, by name.
    std::map<std::string, Parameter, std::less<>> parameters() const;

    /// The flat circuit. `parameters` override the .param lines of the top level and the overrides of the netlist.
    Result<Circuit> elaborate(const Values& parameters = {}) const;
};

}  // namespace corpuscle::circuit
