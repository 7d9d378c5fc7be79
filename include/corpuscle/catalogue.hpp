#pragma once
// The catalogues: names, parameters, units and ranges. They are those of `corpuscle list`.

#include <string>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// A parameter of an afferent, a component, a stimulus or a contact.
struct ParameterDescription {
    std::string name;          ///< "f_B"
    std::string unit;          ///< an SI unit; "" for a dimensionless number
    double default_value = 0;  ///< in `unit`
    double low = 0, high = 0;  ///< the allowed range in `unit`, ends included; infinite if there is no limit
    std::string description;
    std::string source;  ///< publication of the default
};

/// An entry of a catalogue.
struct CatalogueEntry {
    std::string name;    ///< "sa1", "press"
    std::string detail;  ///< composition of an afferent, unit of a measure, extensions of a format; "" for other kinds
    std::string description;
    std::string source;  ///< publication or file; may be ""
    std::vector<ParameterDescription> parameters;
};

/// The names of all catalogues: "afferents", "stimuli" ...
CORPUSCLE_API std::vector<std::string> catalogues();
/// The entries of one catalogue. Throws InputError if there is no such catalogue.
CORPUSCLE_API std::vector<CatalogueEntry> catalogue(const std::string& name);

}  // namespace corpuscle
