#pragma once
// A foundry's kit as a user names it.

#include "circuit/export/kit_arrays.hpp"

namespace corpuscle {

/// Its file, the map of its spelling, and the names of its transistors, as typed. Empty texts are not given.
struct KitRequest {
    std::string card = {}, map = {};
    std::string nch = {}, pch = {}, hv_nch = {}, hv_pch = {};
    /// The first option that is given, such as "--card"; "" if none is.
    std::string_view first_option() const;
};

/// The kit of a request that names something. `deck`: the file of the deck, to whose folder paths in it are relative; "": they are
/// absolute.
Result<circuit::Kit> read_kit(const KitRequest&, const std::string& deck);

}  // namespace corpuscle
