#pragma once
// Checks the file of a foundry's kit, which the deck reads. Its equations are left to ngspice.

#include "circuit/export/kit_map.hpp"

namespace corpuscle::circuit {

/// Returns an error if the text of a kit's file has no .model or .subckt for a device of the map, unless it reads other files, or has it
/// with the other polarity.
Result<void> check_devices_in_card(const KitMap&, std::string_view text, const std::string& path);

/// Reads a kit's file, checks its devices, and returns an error if its .include lines lead back to a file. All files that it includes are
/// registered as inputs, so no output replaces them.
Result<void> check_card(const KitMap&, const std::string& path);

}  // namespace corpuscle::circuit
