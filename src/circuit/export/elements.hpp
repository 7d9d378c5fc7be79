#pragma once
// One element, or one model, of the flat circuit as a line of an ngspice deck.

#include "circuit/export/names.hpp"

namespace corpuscle::circuit {

/// Ends with a newline; may be several lines.
Result<std::string> element_text(const Circuit&, std::size_t element, const ExportNames&);

/// A diode's, or the temperature at which an R, C or L was measured; "" where all numbers are in the elements' lines.
std::string model_text(const Circuit&, std::size_t model, const ExportNames&);

}  // namespace corpuscle::circuit
