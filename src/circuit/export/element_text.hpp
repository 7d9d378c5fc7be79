#pragma once
// Elements, models and directives of the flat circuit as lines of an ngspice netlist.

#include <string>
#include <vector>

#include "circuit/device/uicm_card.hpp"
#include "circuit/export/export_names.hpp"

namespace corpuscle::circuit {

/// An element that is being exported, as the write functions of devices see it.
struct ElementExport {
    const Circuit& circuit;
    const Element& element;
    const ExportNames& names;
    std::string head;  ///< its name and nodes in the export

    /// The model of the element; null if it has none.
    const Model* model() const { return circuit.model_of(element); }
    /// The value with this name of the element.
    double value(std::string_view name, double default_value) const;
    /// " temp=..." or " dtemp=..." if the element has it.
    std::string temperature() const;
    /// The expression of the element. That of a current or a charge is multiplied by m.
    Result<std::string> expression() const;
};

/// The text of an element; ends with a newline and may have several lines.
Result<std::string> element_text(const Circuit&, std::size_t element, const ExportNames&);

/// The .model line of a diode, or of an R, C or L whose model has tnom; "" for other models, whose numbers the elements' lines contain.
std::string model_text(const Circuit&, std::size_t model, const ExportNames&);

/// All directives as lines, with analyses first. Directives that ngspice does not have become comments. Appends to `warnings`: a message
/// for each of them, and for each directive whose results differ in ngspice.
std::string directives_text(const Circuit&, const ExportNames&, std::vector<Error>& warnings);

/// Functions that the subcircuits uicm_n and uicm_p use.
std::string uicm_functions();

/// The subcircuit ".subckt uicm_n d g s b ..." or uicm_p.
std::string uicm_subcircuit(bool pmos);

/// The parameters of one transistor at its temperature (degrees Celsius): "vt=0.4606 slope=1.27 ...".
std::string uicm_parameters(const UicmCard&, const UicmInstance&, double temperature, bool pmos);

}  // namespace corpuscle::circuit
