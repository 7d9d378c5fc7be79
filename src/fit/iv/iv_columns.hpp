#pragma once
// Which column holds which quantity of an I-V curve.

#include <span>
#include <string_view>

#include "fit/iv/iv_data.hpp"

namespace corpuscle {

/// How the numbers of a column become a quantity in SI (Celsius for temperatures): x factor + offset.
struct IvColumn {
    std::size_t index = 0;
    double factor = 1, offset = 0;
};
using IvColumns = std::array<std::optional<IvColumn>, iv_quantities>;

/// Finds the columns by the names that are usual, such as VGS, I_D (uA), v(g), i(vd), @m1[id]; --column takes precedence. The current
/// through a voltage source of SPICE flows out of the terminal, so i(vd) has the opposite sign of I_D.
Result<IvColumns> find_iv_columns(std::span<const std::string> headings, const std::vector<IvColumnChoice>&);

}  // namespace corpuscle
