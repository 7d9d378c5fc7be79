#pragma once
// A SPICE netlist: its text as statements, and the flat circuit that it becomes once its parameters have values.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "circuit/netlist/formula.hpp"
#include "signal/error.hpp"

namespace corpuscle::circuit {

/// name=value, worked out; names in small letters.
using Values = std::map<std::string, double, std::less<>>;

/// A source's course in time, and its part in .ac.
struct Waveform {
    enum class Shape { none, pulse, sine, exponential, points, force } shape = Shape::none;
    double dc = 0;
    bool has_dc = false;
    double ac_magnitude = 0, ac_phase = 0;  ///< phase in degrees
    std::vector<double> numbers;            ///< as they stand in PULSE( SIN( EXP( ; points: t1 v1 t2 v2 ...
};

/// An element, all its numbers worked out.
struct Element {
    std::string name;        ///< small letters; inside subcircuits with their path: "x1.xinv.m1"
    char letter = 0;         ///< r c l v i e f g h b d m
    std::vector<int> nodes;  ///< numbers in Circuit::nodes, in the netlist's order; E, G: the controlling ones too
    Place place;
    int model = -1;                   ///< in Circuit::models
    double value = 0;                 ///< R C L: ohm, farad, henry; E F G H: the gain
    Values values;                    ///< everything said by name: w, l, m, stack, delvto, ic, tc1 ...
    Waveform waveform;                ///< V, I
    std::optional<Formula> formula;   ///< B (v= or i=), C (q=), E and G (value=)
    bool formula_is_voltage = false;  ///< B: v= rather than i=
    std::string control;              ///< F, H: name of the voltage source whose current controls, with its path
};

struct Model {
    std::string name, type;  ///< d, nmos, pmos, r, c, ... in small letters; the name with its subcircuit's path, if it is a local one
    Place place;
    Values values;
    std::map<std::string, std::string, std::less<>> words;  ///< those that are no numbers: in double quotes, and version=3.3.0
};

/// A line that asks for something: .op, .dc, .ac, .meas, .print, .save, .expect, ... Its words in small letters but for quoted ones,
/// formulas in braces already replaced by their values.
struct Command {
    std::string name;  ///< "op", "dc", ... without the dot
    std::vector<std::string> words;
    std::vector<int> columns;  ///< of each word
    Place place;
};

/// A netlist with all its subcircuits put in place and all its parameters worked out.
struct Circuit {
    std::string title, file;
    std::vector<std::string> nodes{"0"};  ///< 0 is ground ("0", "gnd")
    std::vector<Element> elements;
    std::vector<Model> models;
    std::vector<Command> commands;
    Values options;                                                ///< .options; a flag is 1
    std::map<std::string, std::string, std::less<>> option_words;  ///< those whose value is a word: method=gear
    double temperature = 27;                                       ///< C
    std::vector<std::pair<int, double>> ic, nodesets;              ///< node, V
    std::vector<Error> remarks;                                    ///< what deserves a warning, such as "1F is a femtofarad"
    Values parameters;                                             ///< .param of the top level
    std::optional<std::uint64_t> mismatch;                         ///< it is a chip of a draw of this seed,
    std::uint64_t chip = 0;                                        ///< the one of this number; copies are those that follow

    std::unordered_map<std::string, int> node_numbers, element_numbers;  ///< by name, as elaborate() leaves them

    int node(std::string_view name) const;     ///< its number, or -1
    int element(std::string_view name) const;  ///< its number, or -1
};

/// What is set of a netlist from outside, over what it says.
struct Changes {
    std::string corner;                                  ///< the section that its libraries are read for; "": those that it names
    Values parameters;                                   ///< .param of the top level
    std::map<std::string, Values, std::less<>> numbers;  ///< of elements, by their names with their paths; "" is the value of R C L V I ...
    std::optional<double> temperature;                   ///< C
    std::optional<std::uint64_t> mismatch;               ///< the seed of the chip that is drawn; then .mc is left out
    std::uint64_t chip = 0;                              ///< its number
    std::vector<std::string> saved;                      ///< as if a .save named them
    bool numbers_changed() const { return !corner.empty() || !parameters.empty() || !numbers.empty() || temperature || mismatch; }
    bool saved_alone = false;  ///< in place of every .save
};

/// The statements of a netlist and of all files it includes.
class Netlist {
    struct Parsed;
    std::shared_ptr<const Parsed> parsed_;
    std::shared_ptr<const Changes> changes_;

public:
    /// Opens what is included: gives the text of a file, by its path as resolved against the including file.
    using Opener = std::function<Result<std::string>(const std::string& path)>;
    /// `corner`: the section to be read in place of the one that a line `.lib 'file' section` names, where the file has it; refused where
    /// none has.
    static Result<Netlist> parse(std::string text, std::string file, const Opener& open, const std::string& corner = "");
    static Result<Netlist> read(const std::string& path, const std::string& corner = "");

    /// The same with what is set of it. Its corner is of parse() alone.
    Netlist with(Changes) const;
    const Changes& changes() const;
    /// .param of the top level.
    struct Parameter {
        std::string text;  ///< as it is written: "2*c_u"
        bool own;          ///< of the netlist and its parts, not of a library
    };
    std::map<std::string, Parameter, std::less<>> parameters() const;

    /// The flat circuit. `parameters` overrule .param of the top level, and what is set.
    Result<Circuit> elaborate(const Values& parameters = {}) const;
};

}  // namespace corpuscle::circuit
