#pragma once
// The lines of the symbols. Used inside circuit/schematic only.

#include "circuit/schematic/shape/shape.hpp"

namespace corpuscle::circuit::schematic {

struct SymbolPath {
    std::string lines;  ///< path data of lines, upright, with the centre at the origin
    std::string solid;  ///< path data of filled areas: arrows
    struct Sign {
        Point at;  ///< its centre
        bool is_plus;
    };
    std::vector<Sign> signs = {};  ///< drawn upright in every orientation
};

/// The symbol of a device. Pins are where shape_of() has them.
SymbolPath symbol_path(const Part&);

}  // namespace corpuscle::circuit::schematic
