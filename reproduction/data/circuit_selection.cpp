#include "reproduction/data/circuit_selection.hpp"

#include <fmt/format.h>

namespace corpuscle {
namespace {

using circuit::Circuit;

Result<StudyValue> value_in(const circuit::Values* values, const char* kind, const std::string& name) {
    const auto blank = name.find(' ');
    const auto owner = name.substr(0, blank), key = blank == std::string::npos ? "" : name.substr(blank + 1);
    if (values == nullptr) return bad_input(fmt::format("the netlist has no {} '{}'", kind, owner));
    if (const auto found = values->find(key); found != values->end()) return StudyValue(found->second);
    if (key == "m" || key == "stack") return StudyValue(1.0);
    return bad_input(fmt::format("the {} '{}' has no value '{}'", kind, owner, key));
}

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> out(1);
    for (const char c : text) c == ' ' ? void(out.emplace_back()) : out.back().push_back(c);
    return out;
}

/// The size of an array of unit transistors; W and L in m.
struct ArraySize {
    double W = 0, L = 0, columns = 0, stack = 0;
};
Result<ArraySize> size_of(const Circuit& circuit, const std::string& device) {
    ArraySize out;
    for (const auto& [part, key] : {std::pair{&out.W, "w"}, {&out.L, "l"}, {&out.columns, "m"}, {&out.stack, "stack"}}) {
        const auto value = TRY(device_value(circuit, fmt::format("{} {}", device, key)));
        *part = std::get<double>(value);
    }
    return out;
}

}  // namespace

Result<StudyValue> device_value(const Circuit& circuit, const std::string& name) {
    const auto k = circuit.find_element(name.substr(0, name.find(' ')));
    return value_in(k < 0 ? nullptr : &circuit.elements[static_cast<std::size_t>(k)].values, "device", name);
}

Result<StudyValue> model_value(const Circuit& circuit, const std::string& name) {
    for (const auto& model : circuit.models)
        if (model.name == name.substr(0, name.find(' '))) return value_in(&model.values, "model", name);
    return value_in(nullptr, "model", name);
}

Result<StudyValue> aspect_ratio(const Circuit& circuit, const std::string& device) {
    const auto size = TRY(size_of(circuit, device));
    return StudyValue(size.W / size.L * size.columns / size.stack);
}

Result<StudyValue> has_device(const Circuit& circuit, const std::string& name) {
    return StudyValue(circuit.find_element(name) < 0 ? 0.0 : 1.0);
}

Result<StudyValue> has_sizes(const Circuit& circuit, const std::string& devices_and_size) {
    const auto colon = devices_and_size.find(": ");
    if (colon == std::string::npos) return bad_input("write sizes[DEVICES: COLUMNSxSTACK of W/L], W and L in um");
    for (const auto& device : split_words(devices_and_size.substr(0, colon))) {
        const auto size = TRY(size_of(circuit, device));
        const auto text = fmt::format("{:g}x{:g} of {:g}/{:g}", size.columns, size.stack, 1e6 * size.W, 1e6 * size.L);
        if (text != devices_and_size.substr(colon + 2)) return StudyValue(0.0);
    }
    return StudyValue(1.0);
}

Result<StudyValue> gate_area(const Circuit& circuit, const std::string& devices) {
    double area = 0;
    for (const auto& device : split_words(devices)) {
        const auto size = TRY(size_of(circuit, device));
        area += 1e12 * size.columns * size.stack * size.W * size.L;
    }
    return StudyValue(area);
}

Result<StudyValue> widths(const Circuit& circuit, const std::string& type) {
    StudyList out;
    for (const auto& e : circuit.elements)
        if (e.letter == 'm' && circuit.models[static_cast<std::size_t>(e.model)].type == type)
            out.push_back(1e6 * e.values.find("w")->second);
    return StudyValue(std::move(out));
}

}  // namespace corpuscle
