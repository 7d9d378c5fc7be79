#pragma once
// The list of all targets of `corpuscle export`. To add target x, write src/run/export/x.cpp, which defines `x_target`, and add its name to
// both lists.

#include <functional>

#include "core/parameter_override.hpp"
#include "run/export/kit_request.hpp"

namespace corpuscle {

/// A netlist or an afferent in the format of another simulator.
struct ExportedModel {
    std::string text;  ///< the complete file
    /// Messages about parts of the model that the target does not have, or that differ.
    std::vector<Error> warnings;
};

/// The subject of an export as typed, and the settings of its parameters.
struct ExportRequest {
    std::string subject;  ///< "sa1", "amplifier.cir"
    std::vector<ParameterOverride> settings;
    KitRequest kit = {};     ///< for targets with takes_kit
    std::string block = {};  ///< for targets with takes_block: the block of a netlist, "summer"; "": its top level
    std::string out = {};    ///< the file that will contain the text; "": not known. Paths in the text are relative to its folder
};

/// A simulator.
struct ExportTarget {
    std::string_view name;         ///< "brian2"
    std::string_view description;  ///< one line for --help
    std::string_view kind;         ///< "deck", "script": the name of the text in JSON documents
    bool takes_kit = false;        ///< true: transistors of a foundry's kit can replace those of a netlist
    bool takes_block = false;      ///< true: it writes one level of a netlist
    bool is_text;                  ///< false: bytes, which are not printed
    Result<ExportedModel> (*write)(const ExportRequest&);
    bool (*is_own)(std::string_view beginning);  ///< true for the first bytes of a file that an earlier export wrote
};

extern const ExportTarget ngspice_target, brian2_target, neuron_target, verilog_a_target, nir_target, svg_target;

inline constexpr const ExportTarget* export_targets[] = {&ngspice_target,   &brian2_target, &neuron_target,
                                                         &verilog_a_target, &nir_target,    &svg_target};

/// The target of this name; null if there is none.
const ExportTarget* find_export_target(std::string_view name);

/// Writes a subject for a target. Returns an error if a kit is given and the target takes none.
Result<ExportedModel> write_model(const ExportTarget&, const ExportRequest&);

}  // namespace corpuscle
