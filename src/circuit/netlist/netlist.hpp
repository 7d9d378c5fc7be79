#pragma once
// A SPICE netlist: its parsed statements, and the flat circuit that results once its parameters have values.

#include <map>
#include <unordered_map>

#include "circuit/error_at.hpp"
#include "circuit/expression/expression.hpp"

namespace corpuscle::circuit {

/// Evaluated name=value pairs; names in small letters.
using Values = std::map<std::string, double, std::less<>>;

/// The specification of a source: DC value, AC stimulus and time waveform. Values are in V or A.
struct Waveform {
    enum class Shape {
        none,
        pulse,
        sine,
        exponential,
        piecewise_linear,
        force,
        frequency_modulated,
        amplitude_modulated,
        noise
    } shape = Shape::none;
    double dc = 0;
    bool has_dc = false;                    ///< true if the netlist or an override gives the DC value
    double ac_magnitude = 0, ac_phase = 0;  ///< phase in degrees
    std::vector<double> numbers;  ///< the arguments of PULSE, SIN, EXP, SFFM or AM; for PWL t1 v1 t2 v2 ...; for FORCE the scale (per N)
    std::optional<double> repeats_from = {};  ///< s: a PWL repeats its part from this time on
};

struct DeviceKind;

/// An element with all its values evaluated.
struct Element {
    std::string name;                  ///< in small letters, with the path of its subcircuit: "x1.xinv.m1"
    const DeviceKind* kind = nullptr;  ///< the row of its kind of device
    char letter = 0;                   ///< of its name; of a device inside a subcircuit, that of the name after the path
    std::vector<int> nodes;            ///< indices in Circuit::nodes, in netlist order; for E and G including the controlling nodes
    SourceLocation location;
    int model = -1;                        ///< index in Circuit::models; -1 if the element has no model
    double value = 0;                      ///< for R, C, L in ohm, farad, henry; for E, F, G, H the gain
    Values values;                         ///< all values given by name: w, l, m, stack, delvto, ic, tc1 ...
    Waveform waveform;                     ///< for V and I
    std::optional<Expression> expression;  ///< for B (v= or i=), C (q=), E and G (value=)
    bool expression_is_voltage = false;  ///< for B, E and G: true if the expression gives a voltage (v=, or value= of E), false: a current
    std::string control_source;          ///< for F and H: the controlling voltage source, with its path
    std::vector<std::string> inductors;  ///< for K: the coupled inductors, with their paths
};

/// A .model line with all its values evaluated.
struct Model {
    std::string name, type;  ///< types are d, nmos, pmos, r, c, ...; the name of a local model has the path of its subcircuit
    SourceLocation location;
    Values values;
    Values tolerances;                                      ///< dev and lot; see RandomValues
    std::map<std::string, std::string, std::less<>> texts;  ///< values that are not numbers: text in double quotes, and version=3.3.0
};

/// True for a word of LTspice's or Xyce's .tran that has no effect here.
bool is_modifier_of_tran(std::string_view word);

/// A directive of the circuit: .op, .dc, .ac, .meas, .print, .save, .expect, ... Words are in small letters except for quoted ones, and
/// expressions in braces are replaced by their values.
struct Directive {
    std::string name;  ///< "op", "dc", ... without the dot
    std::vector<std::string> words;
    std::vector<int> columns;  ///< of each word in its line of the file, from 1; empty for a directive of an override
    SourceLocation location;
    /// The location of the analysis to which a print or meas of a script applies. It applies to any analysis if this is empty.
    std::optional<SourceLocation> analysis_location = {};
    bool applies_to(const Directive& analysis) const {
        return !analysis_location ||
               (analysis_location->line == analysis.location.line && analysis_location->file == analysis.location.file);
    }
    /// The location of a word, counted from 0. Without a column if the directive has no such word.
    SourceLocation location_of(std::size_t word) const;
};

/// True if a .tran begins with given voltages: it has the word uic.
bool starts_from_initial_conditions(const Directive&);

/// A flat netlist: subcircuits are expanded and parameters are evaluated.
struct Circuit {
    std::string title, file;
    std::vector<std::string> nodes{"0"};  ///< names; index 0 is ground ("0", "gnd")
    std::vector<Element> elements;
    std::vector<Model> models;
    std::vector<Directive> directives;
    Values options;                                                ///< numbers and flags of .options; a flag is 1
    std::map<std::string, std::string, std::less<>> option_words;  ///< options whose value is a word: method=gear
    double temperature = 27;                                       ///< degrees Celsius
    std::vector<std::pair<int, double>> ic, nodesets;              ///< .ic and .nodeset: index in `nodes`, V
    std::vector<Error> warnings;                                   ///< such as "1F is 1 femtofarad"
    Values parameters;                                             ///< values of the top level's .param lines
    std::optional<std::uint64_t> mismatch_seed;                    ///< seed of the mismatch override; empty for the nominal circuit
    std::uint64_t chip = 0;                                        ///< number of the chip among those of this seed, from 0
    bool has_random_values = false;                                ///< true if values differ from chip to chip; see RandomValues

    std::unordered_map<std::string, int> node_numbers, element_numbers;  ///< indices by name, filled by Netlist::elaborate()

    /// The directives of this name, in the order of the netlist.
    auto directives_named(std::string_view name) const {
        return directives | std::views::filter([name](const Directive& c) { return c.name == name; });
    }
    bool has_directive(std::string_view name) const { return !directives_named(name).empty(); }
    int find_node(std::string_view name) const;     ///< the index of the node; -1 if no node has this name
    int find_element(std::string_view name) const;  ///< the index of the element; -1 if no element has this name
    /// The model of an element; null if it has none.
    const Model* model_of(const Element& e) const { return e.model < 0 ? nullptr : &models[static_cast<std::size_t>(e.model)]; }
};

/// Warns about nodes with one connection only, transistor sizes in metres that were probably meant in micrometres, missing sizes, ic= and
/// off without effect, .ac without an AC source, pulses longer than their period, and a .tran whose STEP is longer than STOP. There is one
/// warning of each kind for all elements, located at the first of them, and one for each such node and .tran.
std::vector<Error> netlist_warnings(const Circuit&);
/// True if the circuit is not the same on each chip: it has UICM transistors, random values or noise.
bool varies_with_chip(const Circuit&);
/// Why all chips of .mc or of the mismatch override are equal; "" if they differ, or if neither is given.
std::string_view reason_no_variation(const Circuit&);

/// True for a number of .options that has an effect here.
bool is_numeric_option(std::string_view name);
/// Returns an error if the name of an option or its value is invalid. The value is `number` or `word`; an option without both is a flag.
Result<void> check_option(std::string_view name, std::optional<double> number, std::optional<std::string_view> word,
                          const SourceLocation& location);

/// Overrides of the values in a netlist.
struct ResolvedOverrides {
    std::string corner;                                  ///< section to read from libraries; "" means the sections that the netlist names
    Values parameters;                                   ///< new values for .param lines of the top level
    std::map<std::string, Values, std::less<>> numbers;  ///< values by full path of the element; the name "" is the value of R C L V I ...
    Values options;                                      ///< new values for numbers of .options
    std::optional<double> temperature;                   ///< degrees Celsius
    std::optional<std::uint64_t> mismatch_seed;          ///< seed of the mismatch sample; if set, .mc is ignored
    std::uint64_t chip = 0;                              ///< number of the chip among those of this seed, from 0
    std::vector<std::string> saved;                      ///< names for an additional .save
    /// True if the circuit differs from the netlist as written, so that .expect does not hold.
    bool changes_values() const {
        return !corner.empty() || !parameters.empty() || !numbers.empty() || !options.empty() || temperature || mismatch_seed;
    }
    bool replaces_saved = false;  ///< true: `saved` replaces every .save and .probe
};

/// An X line: an instance of a subcircuit.
struct SubcircuitInstance {
    std::string path;                  ///< "x1.xres"
    std::string subcircuit;            ///< the name of its definition
    std::vector<std::string> ports;    ///< names of the ports, in the order of the .subckt line
    std::vector<int> inside, outside;  ///< indices in Circuit::nodes of each port, and of the node to which the X line connects it
};

/// A circuit whose subcircuits are kept apart: each port of an instance is a node of its own, such as "x1.in", and not the node outside. A
/// port that is named as ground is ground. It is for drawings; it cannot be simulated.
struct HierarchicalCircuit {
    Circuit circuit;
    std::vector<SubcircuitInstance> instances;  ///< an instance comes before those that it contains
};

/// Selects the chip whose random values a netlist takes; see RandomValues.
struct RandomDraws {
    std::uint64_t seed = 0, chip = 0;
    bool has_process = true;   ///< the values of all elements of a model vary together
    bool has_mismatch = true;  ///< each value varies by itself
};

/// The statements of a netlist and of all files that it includes.
class Netlist {
    struct Impl;
    std::shared_ptr<const Impl> impl_;
    std::shared_ptr<const ResolvedOverrides> overrides_;

public:
    /// Returns the text of an included file. A relative path has already been joined to the folder of the including file.
    using FileOpener = std::function<Result<std::string>(const std::string& path)>;
    /// Parses a netlist. `file` is its path, for messages and for included files. `corner` replaces the section of each line
    /// `.lib 'file' section` whose file has a section with the name of the corner. It is an error if no file has one. "" replaces nothing.
    static Result<Netlist> parse(std::string text, std::string file, const FileOpener& open, const std::string& corner = "");
    /// Parses the netlist in a file.
    static Result<Netlist> read(const std::string& path, const std::string& corner = "");
    /// Parses a text. Paths of included files are relative to the folder of `file`, which need not exist.
    static Result<Netlist> parse_text(std::string text, std::string file, const std::string& corner = "");

    /// The same netlist with these overrides, which replace earlier ones. Their corner has no effect here, because parse() applies it.
    Netlist with_overrides(ResolvedOverrides) const;
    const ResolvedOverrides& overrides() const;
    /// A parameter that a .param line of the top level defines.
    struct Parameter {
        std::string text;            ///< as written in the netlist: "2*c_u"
        bool is_defined_in_netlist;  ///< false: defined in a library section
    };
    /// All parameters of the top level, by name.
    std::map<std::string, Parameter, std::less<>> parameters() const;
    /// The process corners that parse() accepts: the sections of the libraries of which the netlist reads one.
    std::vector<std::string> corners() const;

    /// The flat circuit. `parameters` replace .param lines of the top level, even those that the netlist's overrides set. Random values are
    /// their means, unless `draws` or the mismatch override selects a chip.
    Result<Circuit> elaborate(const Values& parameters = {}, std::optional<RandomDraws> draws = {}) const;
    /// The same elements with the same values, in a circuit whose subcircuits are kept apart.
    Result<HierarchicalCircuit> elaborate_hierarchy() const;

    /// A subcircuit that the top level defines.
    struct Subcircuit {
        std::string name;
        std::vector<std::string> ports;
    };
    /// All subcircuits that the top level defines, by name.
    std::vector<Subcircuit> subcircuits() const;
    /// A circuit of one subcircuit of the top level with its default parameters, whether an X line uses it or not. It is the only instance
    /// of the top level, its path is its name, and each port is connected to a node of the same name.
    Result<HierarchicalCircuit> elaborate_definition(std::string_view subcircuit) const;
};

}  // namespace corpuscle::circuit
