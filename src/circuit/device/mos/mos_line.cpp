#include "circuit/device/mos/mos_line.hpp"

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
Result<void> read_mos_line(ElementReader& line) {
    constexpr std::string_view expected = "drain, gate, source, bulk, then the model";
    if (line.word_count() == 5 && line.is_model(4)) return line.error_at(4, "3 nodes, but expected 4: {}", expected);
    TRY(line.nodes(4, expected));
    if (line.word_count() < 6) return line.error_at(5, "its model is missing");
    if (line.word_count() > 6 && !line.is_model(5) && line.is_model(6)) return line.error_at(5, "5 nodes, but expected 4: {}", expected);
    TRY(line.model(5, {"nmos", "pmos"}));
    for (std::size_t k = 6; k < line.word_count(); ++k) {
        if (line.text(k) == "off")
            line.element.values["off"] = 1;
        else if (line.continues_initial_voltages(k, 2))  // ic=VDS,VGS,VBS
            TRY(line.number(k));
        else
            return line.too_many(k);
    }
    return {};
}

Result<MosSize> read_mos_size(const Element& e) {
    MosSize size;
    for (const auto& f : MosSize::fields)
        if (const auto given = e.values.find(f.name); given != e.values.end()) TRY(read_field(f, size, e.name, given->second, e.location));
    return size;
}

std::vector<int> mos_conducting_nodes(const Element& e) { return {e.nodes[0], e.nodes[2], e.nodes[3]}; }

std::optional<Area> mos_area(const Element& e) {
    const MosSize defaults;
    const double W = value_or(e.values, "w", defaults.W), L = value_or(e.values, "l", defaults.L), m = value_or(e.values, "m", 1);
    Area out;
    out.gates = m * W * L, out.arrays = array_area(W, L, m), out.islands = m * rectangle_area(W, L, 1, 1);
    return out;
}

}  // namespace corpuscle::circuit
