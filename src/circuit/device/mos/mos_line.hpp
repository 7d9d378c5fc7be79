#pragma once
// The line of a MOS transistor, `m1 drain gate source bulk MODEL w=... l=...`, which all levels share.

#include "circuit/device/device_kind.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {

/// Reads nodes, model and `off`.
Result<void> read_mos_line(ElementReader&);

/// Size and surroundings of a transistor, as SPICE has them.
struct MosSize {
    double W = 100e-6, L = 100e-6, m = 1;                     ///< m; number of equal transistors in parallel
    double AD = 0, AS = 0, PD = 0, PS = 0, NRD = 1, NRS = 1;  ///< of one transistor: m^2, m, squares
    static constexpr ParameterDef<MosSize> fields[] = {
        {"w", &MosSize::W, "m", 1e-9, 1e6, "width"},
        {"l", &MosSize::L, "m", 1e-9, 1e6, "length"},
        {"m", &MosSize::m, "", 1e-6, 1e9, "transistors in parallel"},
        {"ad", &MosSize::AD, "m^2", 0, 1, "area of the drain"},
        {"as", &MosSize::AS, "m^2", 0, 1, "area of the source"},
        {"pd", &MosSize::PD, "m", 0, 10, "perimeter of the drain"},
        {"ps", &MosSize::PS, "m", 0, 10, "perimeter of the source"},
        {"nrd", &MosSize::NRD, "", 0, 1e6, "squares of the drain, for rsh"},
        {"nrs", &MosSize::NRS, "", 0, 1e6, "squares of the source, for rsh"},
    };
};
Result<MosSize> read_mos_size(const Element&);

/// The fields of MosSize, then the temperatures.
inline constexpr auto mos_parameters = [] {
    std::array<ElementParameter, std::size(MosSize::fields) + 2> out{};
    for (std::size_t k = 0; k + 2 < out.size(); ++k) {
        const auto& f = MosSize::fields[k];
        out[k] = {f.name, f.unit, f.low, f.high, MosSize{}.*f.member};
    }
    out[out.size() - 2] = parameter_temp, out[out.size() - 1] = parameter_dtemp;
    return out;
}();
inline constexpr std::string_view mos_names[] = {"off", "ic"};  ///< further names of a line

/// Drain, source and bulk, between which direct current flows.
std::vector<int> mos_conducting_nodes(const Element&);
std::optional<Area> mos_area(const Element&);

}  // namespace corpuscle::circuit
