#pragma once
// Models for other simulators.

#include <string>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// A netlist or an afferent in the format of another simulator.
struct ModelText {
    std::string text;                   ///< the complete file
    std::vector<std::string> warnings;  ///< about parts of the model that the simulator does not have
    bool is_text = true;                ///< false: `text` is the bytes of a binary file
};

/// The transistors of a foundry's kit, which replace those of a netlist in a deck for "ngspice" (doc/kits.md). An empty text is the
/// default.
struct ExportKit {
    std::string card;                      ///< the file of the kit; "": no kit
    std::string map;                       ///< how the kit spells its transistors: the name of a built-in map, or a file
    std::string nch, pch, hv_nch, hv_pch;  ///< the kit's devices
    std::string deck;                      ///< the file that will contain the deck, so that a relative path of the card stays one
};

/// The names of all targets: "ngspice", "brian2" ...
CORPUSCLE_API std::vector<std::string> export_target_names();
/// Writes a netlist or an afferent for a target, with settings such as "sa1.f_B=25Hz" (doc/export.md). Throws InputError.
CORPUSCLE_API ModelText export_model(const std::string& subject, const std::string& target, const std::vector<std::string>& settings = {},
                                     const ExportKit& kit = {});

}  // namespace corpuscle
