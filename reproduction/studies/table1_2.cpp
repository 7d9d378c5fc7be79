// Tables 1 and 2: the sizes of the transducer and of its amplifier, compared with the netlists.

#include <fmt/format.h>
#include <algorithm>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::table1_2 {

struct SizeRow {
    const char *table, *name, *devices;  // name as printed; the ends of the device names in our netlist
    double m, n, W;                      // columns, unit transistors in series, um: as printed
    const char* reason = "";             // why our netlist has another size
};
constexpr SizeRow rows[] = {
    {"1", "M_1", "x.mn1", 4, 4, 1.5},
    {"1", "M_2", "x.mn2", 16, 1, 1.5},
    {"1", "M_3 (printed M_1, errata F9)", "x.mn3", 8, 1, 1.5},
    {"2", "M_1A-E", "xamp.mp1a xamp.mp1b xamp.mp1c xamp.mp1d xamp.mp1e", 4, 4, 6},
    {"2", "M_2A-E", "xamp.mp2a xamp.mp2b xamp.mp2c xamp.mp2d xamp.mp2e", 16, 1, 6},
    {"2", "M_1F", "xamp.mp1f", 8, 1, 6},
    {"2", "M_2F", "xamp.mp2f", 8, 1, 6},
    {"2", "M_3A-B", "xamp.mp3a xamp.mp3b", 16, 1, 1.5, "an NMOS width, but V_CM of 0.1 V requires a PMOS pair (errata F10a)"},
    {"2", "M_3C-D", "xamp.mp3c xamp.mp3d", 16, 1, 1.5, "as wide as the pair whose bulks they bias"},
    {"2", "M_4A, B (printed A-E, errata F10)", "xamp.mn4a xamp.mn4b", 4, 4, 1.5},
    {"2", "M_5A, B (printed A-E, errata F10)", "xamp.mn5a xamp.mn5b", 16, 1, 1.5},
    {"2", "M_4C", "xamp.mn4c", 8, 1, 1.5},
    {"2", "M_5C", "xamp.mn5c", 8, 1, 1.5},
};

/// A value of a transistor. Only m and stack can be missing, and then are 1.
double value_or_1(const circuit::Element& e, const char* name) {
    const auto at = e.values.find(name);
    return at == e.values.end() ? 1 : at->second;
}

const circuit::Element* find_device(const circuit::Circuit& circuit, const std::string& end) {
    for (const auto& e : circuit.elements)
        if (e.letter == 'm' && ("." + e.name).ends_with("." + end)) return &e;
    return nullptr;
}

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> out(1);
    for (const char c : text) c == ' ' ? void(out.emplace_back()) : out.back().push_back(c);
    return out;
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto circuit = elaborate_study_netlist({"transducer"});
    if (!circuit) return circuit.error();
    for (const auto& row : rows) {
        double m = Claim::none, n = Claim::none, W = Claim::none;  // of the row's first device
        bool matches = true;
        for (const auto& name : split_words(row.devices)) {
            const auto* e = find_device(**circuit, name);
            if (e == nullptr) return Error{ErrorCode::bad_input, fmt::format("transducer: no transistor {}", name)};
            const bool first = m != m;
            if (first) m = value_or_1(*e, "m"), n = value_or_1(*e, "stack"), W = value_or_1(*e, "w");
            matches = matches && value_or_1(*e, "m") == m && value_or_1(*e, "stack") == n && value_or_1(*e, "w") == W &&
                      value_or_1(*e, "l") == 0.5e-6;
        }
        matches = matches && m == row.m && n == row.n && W == row.W * 1e-6;
        auto& c = out.claim_true(fmt::format("{}: {:g} by {:g} of {:g}/0.5 um", row.name, row.m, row.n, row.W), matches,
                                 fmt::format("table {}", row.table));
        c.explain_if_needed(row.reason);
    }
    const auto& all = (*circuit)->elements;
    const auto of_width = [&](const char* type, double W) {
        return std::all_of(all.begin(), all.end(), [&](const auto& e) {
            return e.letter != 'm' || (*circuit)->models[static_cast<std::size_t>(e.model)].type != type || value_or_1(e, "w") == W;
        });
    };
    out.claim_true("every PMOS has W = 6 um", of_width("pmos", 6e-6), "thesis 4.2");
    out.claim_true("every NMOS has W = 1.5 um", of_width("nmos", 1.5e-6), "thesis 4.2");
    return out;
}

const Study study{"table1-2", "Sizes of the transducer and its amplifier",
                  "Arrays of m columns of n unit transistors; every PMOS is 6 um and every NMOS 1.5 um wide. Thesis 4.2, tables 1 and 2",
                  compute};

}  // namespace corpuscle::studies::table1_2
