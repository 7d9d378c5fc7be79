#pragma once
// Elements and models of the flat circuit as lines of an ngspice netlist.

#include "circuit/export/export_names.hpp"

namespace corpuscle::circuit {

/// The text of an element; ends with a newline and may have several lines.
Result<std::string> element_text(const Circuit&, std::size_t element, const ExportNames&);

/// The .model line of a diode, or of an R, C or L whose model has tnom; "" for other models, whose numbers the elements' lines contain.
std::string model_text(const Circuit&, std::size_t model, const ExportNames&);

}  // namespace corpuscle::circuit
