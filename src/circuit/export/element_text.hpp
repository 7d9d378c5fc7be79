#pragma once
// Elements and models of the flat circuit as lines of an ngspice netlist; and the names of nodes, elements and models there: unique, and
// only with characters that ngspice accepts.

#include <set>

#include "circuit/device/uicm_card.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Nodes keep their names ("x1.out"). The name of an element inside a subcircuit begins with its letter: x1.m3 is xm_x1_m3, x1.x2.r1 is
/// r_x1_x2_r1. A transistor is exported as a subcircuit, so its name begins with x. Characters other than a-z 0-9 _ (for nodes also
/// . and #) become _, and names that are then equal get a number.
class ExportNames {
    const Circuit& circuit_;
    std::vector<std::string> nodes_, elements_, models_;

public:
    explicit ExportNames(const Circuit&);

    // Names by index in Circuit::nodes, elements and models.
    const std::string& node(int number) const { return nodes_[static_cast<std::size_t>(number)]; }
    const std::string& element(std::size_t number) const { return elements_[number]; }
    const std::string& model(int number) const { return models_[static_cast<std::size_t>(number)]; }
    /// The exported name of a node or element of the circuit; "" if the circuit has none of this name.
    std::string node(std::string_view name) const;
    std::string element(std::string_view name) const;

    /// A word of a directive with the names in its v(...) and i(...) replaced: "v(x1.a,b)=0.5", "vdb(out)".
    std::string word(std::string_view) const;
};

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

/// The name and the nodes of an element in the export.
std::string element_head(const Circuit&, std::size_t element, const ExportNames&);

/// The text of an element; ends with a newline and may have several lines.
Result<std::string> element_text(const Circuit&, std::size_t element, const ExportNames&);

/// The .model line of a diode, a bipolar or a level 1 transistor, or of an R, C or L whose model has tnom; "" for other models, whose
/// numbers the elements' lines contain.
std::string model_text(const Circuit&, std::size_t model, const ExportNames&);

}  // namespace corpuscle::circuit
