// Tables 16, 19 and 20: the arrays of the bias generator and of the three inverters, compared with the netlists.

#include <fmt/format.h>
#include <cmath>
#include <sstream>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::table16 {

/// A row as printed: m columns of n unit transistors of W by L, um; and the devices of this row in one of our netlists.
struct SizeRow {
    const char *table, *name;
    double m, n, W, L;
    const char *circuit, *devices;
    const char* erratum = "";  ///< the erratum, if the devices of our netlist have another size
};
constexpr SizeRow rows[] = {
    {"16", "M1A-B", 2, 8, 6.0, 0.5, "bias", "m1a m1b"},
    {"16", "M2A-B", 2, 8, 1.5, 0.5, "bias", "m2a m2b"},
    {"16", "M3A,B", 2, 8, 6.0, 0.5, "bias", "m3a m3b"},
    {"16", "M4A-C", 2, 8, 1.5, 0.5, "bias", "m4a m4b m4c"},
    {"16", "M5A,B", 2, 8, 6.0, 0.5, "bias", "m5a m5b"},
    {"19", "INVA M1", 2, 8, 6.0, 0.5, "inverter_biased", "xa.mp1"},
    {"19", "INVA M2", 2, 8, 1.5, 0.5, "inverter_biased", "xa.mn2"},
    {"19", "INVB M1A-C", 2, 8, 6.0, 0.5, "invb", "xh.mp1a xh.mp1b xh.mp1c"},
    {"19", "INVB M2A-C", 2, 8, 1.5, 0.5, "invb", "xh.mn2a xh.mn2b xh.mn2c"},
    {"20", "M1A-C", 2, 8, 6.0, 0.5, "invc", "xh.xb.mp1a xh.xb.mp1b xh.xb.mp1c"},
    {"20", "M2A-C", 2, 8, 1.5, 0.5, "invc", "xh.xb.mn2a xh.xb.mn2b xh.xb.mn2c"},
    {"20", "M3A,C", 8, 1, 6.0, 0.5, "invc", "xh.mp3a xh.mp3c"},
    {"20", "M3B,D", 2, 4, 6.0, 0.5, "invc", "xh.mp3b xh.mp3d"},
    {"20", "M4A,C", 8, 1, 1.5, 0.5, "invc", "xh.mn4a xh.mn4c"},
    {"20", "M4B,D", 2, 4, 1.5, 0.5, "invc", "xh.mn4b xh.mn4d"},
    {"20", "M5A", 16, 1, 6.0, 0.5, "invc", "xh.mp5a"},
    {"20", "M5B", 2, 8, 6.0, 0.5, "invc", "xh.mp5b"},
    {"20", "M6A", 8, 2, 1.5, 0.5, "invc", "xh.mn6a", "S7: 16x1, as M5A"},
    {"20", "M6B", 2, 4, 1.5, 0.5, "invc", "xh.mn6b", "S7: 2x8, as M5B"},
};

const circuit::Element& element_of(const circuit::Circuit& c, const std::string& name) {
    return c.elements[static_cast<std::size_t>(c.find_element(name))];
}
/// A value of a transistor. Only m and stack can be missing, and then are 1.
double value_or_1(const circuit::Element& e, const char* name) {
    const auto found = e.values.find(name);
    return found == e.values.end() ? 1 : found->second;
}
/// Gate area, um^2.
double gate_area(const circuit::Element& e) {
    return 1e12 * value_or_1(e, "m") * value_or_1(e, "stack") * value_or_1(e, "w") * value_or_1(e, "l");
}

/// True if all devices of a row have the printed sizes; adds their gate area to `area`.
bool has_printed_sizes(const SizeRow& row, const circuit::Circuit& c, double& area) {
    bool all = true;
    std::istringstream names(row.devices);
    for (std::string name; names >> name;) {
        const auto& e = element_of(c, name);
        const double built[] = {value_or_1(e, "m"), value_or_1(e, "stack"), 1e6 * value_or_1(e, "w"), 1e6 * value_or_1(e, "l")};
        const double printed[] = {row.m, row.n, row.W, row.L};
        for (int k = 0; k < 4; ++k) all = all && std::abs(built[k] - printed[k]) < 1e-9;
        area += gate_area(e);
    }
    return all;
}

/// Effect of M6 on INVC: the ratio of its output currents at V_IN = V_DD and at V_IN = 0.
Result<void> add_symmetry(StudyResult& out) {
    double ratios[2];  // with M6 as built, as printed
    for (const bool printed : {false, true}) {
        std::vector<std::string> settings;
        if (printed) settings = {"xh.mn6a=8x2", "xh.mn6b=2x4"};
        const auto found = run_study_netlist({"invc", settings, ".dc vin 0 0.7 10m"});
        if (!found) return found.error();
        const auto I = found->curve("dc", "i(vhalf)");
        ratios[printed] = std::abs(I.y.back() / I.y.front());
    }
    out.claim("INVC with M6 as built: output current at V_IN = V_DD over that at 0", ratios[0], "times")
        .derived_as(1, "fig. 60a: the exact same shape as INVB's, which is symmetric");
    out.claim("INVC with M6 as printed: output current at V_IN = V_DD over that at 0", ratios[1], "times")
        .allow_range(0.9, 1.1, "fig. 60a: the exact same shape as INVB's, which is symmetric")
        .explain("M6 as printed divides by 8, but M5 by 64: errata S7");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    std::map<std::string, std::shared_ptr<const circuit::Circuit>> circuits;
    std::map<std::string, double> areas;  // um^2, of "INVA", "INVB", "table 16", "table 20"
    for (const auto& row : rows) {
        auto& c = circuits[row.circuit];
        if (!c) {
            auto built = elaborate_study_netlist({row.circuit});
            if (!built) return built.error();
            c = std::move(*built);
        }
        const auto source = fmt::format("table {}", row.table);
        auto& area = areas[std::string_view(row.name).starts_with("INV") ? std::string(row.name, 4) : source];
        auto& claim =
            out.claim_true(fmt::format("table {}: {} is {:g}x{:g} of {:g}/{:g} um", row.table, row.name, row.m, row.n, row.W, row.L),
                           has_printed_sizes(row, *c, area), source);
        if (claim.needs_explanation()) claim.explain(fmt::format("our netlist follows errata {}", row.erratum));
    }
    out.claim("gate area of the bias generator", areas["table 16"], "um^2");
    out.claim("gate area of INVA", areas["INVA"], "um^2");
    out.claim("gate area of INVB over INVA's", areas["INVB"] / areas["INVA"], "times").published_as(3, "E.3: three times more area");
    out.claim("gate area of INVC over INVA's", areas["table 20"] / areas["INVA"], "times");
    if (auto ok = add_symmetry(out); !ok) return ok.error();
    out.note(
        "The replica that the text calls M4A and M5C is M4C and M5B (errata I6): table 16 has no M5C, and M4A and M5A set BN and BP. Table "
        "19 has the caption of table 16 (errata I12).");
    return options.report_progress(1) ? Result<StudyResult>(out) : options.report_progress(1).error();
}

const Study study{"table16", "The inverters' arrays as built",
                  "Sizes of the bias generator and of INVA, INVB and INVC. Thesis tables 16, 19 and 20", compute};

}  // namespace corpuscle::studies::table16
