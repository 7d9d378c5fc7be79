#pragma once
// A netlist under other orders than its own.

#include <string>

namespace corpuscle {

/// The text without its analyses, measures and other orders, their lines left empty, and these lines at its end.
std::string with_orders(const std::string& text, const std::string& orders);

}  // namespace corpuscle
