// Compares every array of the chips' netlists with the sizes published in the thesis: tables 1 to 9, 16, 19 and 20, including misprints.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <sstream>

#include "netlist_runner.hpp"
#include "published_sizes.hpp"

namespace corpuscle::circuit {
namespace {

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

/// Number of devices that a name in a table stands for: five for "M1A-E", two for "M3A,C".
int device_count(const std::string& name) {
    if (const auto to = name.find('-'); to != std::string::npos) return name[to + 1] - name[to - 1] + 1;
    return name.find(',') != std::string::npos ? 2 : 1;
}

double named_value(const Element& e, const char* name, double fallback) {
    const auto found = e.values.find(name);
    return found == e.values.end() ? fallback : found->second;
}

/// m, n, W, L of an array, lengths in um.
std::vector<std::pair<std::string, double>> size_of(const Element& e) {
    return {{"m", named_value(e, "m", 1)},
            {"n", named_value(e, "stack", 1)},
            {"W", 1e6 * named_value(e, "w", 0)},
            {"L", 1e6 * named_value(e, "l", 0)}};
}

/// The circuits of table_locations. If `replaced_file` names a subcircuit file, `replacement` is its text, and circuits without subcircuit
/// files are left out.
class Circuits {
    std::map<std::string, Circuit> circuits_;

    void read(const std::string& name, const Values& parameters, const std::string& replaced_file, const std::string& replacement) {
        const auto path = fmt::format("{}/circuits/{}.cir", test::source_root(), name);
        const auto text = read_text_file(path);
        if (!text) return ADD_FAILURE() << text.error().text(), void();
        if (text->find("'parts/") == std::string::npos && !replaced_file.empty()) return;
        const auto netlist = Netlist::parse(*text, path, [&](const std::string& file) -> Result<std::string> {
            if (!replaced_file.empty() && file.ends_with("/" + replaced_file)) return replacement;
            return circuit::read_text_file(file);
        });
        if (!netlist) return ADD_FAILURE() << netlist.error().text(), void();
        auto circuit = netlist->elaborate(name == "sa1" || name == "fa1" ? parameters : Values());
        if (!circuit) return ADD_FAILURE() << circuit.error().text(), void();
        circuits_.emplace(name, std::move(*circuit));
    }

public:
    explicit Circuits(const Values& parameters, const std::string& replaced_file = "", const std::string& replacement = "") {
        std::set<std::string> names;
        for (const auto& location : table_locations) names.insert(location.circuit);
        for (const auto& name : names) read(name, parameters, replaced_file, replacement);
    }
    bool contain(const std::string& name) const { return circuits_.contains(name); }
    const Circuit& operator[](const std::string& name) const { return circuits_.at(name); }
};

/// Differences from the tables, one text each. `used` collects the errata that apply, `sized` the devices found in each circuit.
struct TableComparison {
    std::vector<std::string> differences;
    std::set<const SizeDeviation*> used;
    std::map<std::string, std::set<std::string>> sized;

    explicit TableComparison(const Circuits& circuits) {
        for (const auto& location : table_locations)
            for (const auto& row : published_sizes)
                if (std::string_view(row.table) == location.table && circuits.contain(location.circuit))
                    for (const auto& local : words(row.devices)) device(circuits[location.circuit], location, row, local);
    }
    void device(const Circuit& circuit, const TableLocation& location, const PublishedSize& row, const std::string& local) {
        const auto name = location.path + local;
        sized[location.circuit].insert(name);
        const int k = circuit.find_element(name);
        if (k < 0) return differences.push_back(fmt::format("table {} {}: {}.cir has no {}", row.table, row.name, location.circuit, name));
        const double printed[] = {double(row.m), double(row.n), row.W, row.L};
        const auto size = size_of(circuit.elements[static_cast<std::size_t>(k)]);
        for (std::size_t j = 0; j < 4; ++j)
            if (const double expected = expected_size(row, local, size[j].first, printed[j]); std::abs(size[j].second - expected) > 1e-9)
                differences.push_back(fmt::format("table {} {}: {} is printed as {}, {}.cir has {} in {}, for which there is no erratum",
                                                  row.table, row.name, size[j].first, printed[j], location.circuit, size[j].second, name));
    }
    double expected_size(const PublishedSize& row, const std::string& local, const std::string& what, double printed) {
        for (const auto& other : size_deviations) {
            if (std::string_view(other.table) != row.table || std::string_view(other.name) != row.name || what != other.parameter) continue;
            const auto devices = words(other.device);
            if (std::find(devices.begin(), devices.end(), local) == devices.end()) continue;
            used.insert(&other);
            return other.built_value;
        }
        return printed;
    }
};

Values as_printed(double value) { return {{"as_printed", value}}; }

TEST(Tables, GiveTheSizeOfEveryArrayExceptForTheErrata) {
    const TableComparison compared{Circuits(as_printed(1))};
    EXPECT_TRUE(compared.differences.empty()) << fmt::format("{}", fmt::join(compared.differences, "\n"));
    for (const auto& other : size_deviations)
        EXPECT_TRUE(compared.used.contains(&other))
            << "table " << other.table << " " << other.name << ": no array deviates by erratum " << other.erratum;
}

TEST(Tables, EveryPublishedDeviceIsInTheCircuits) {
    for (const auto& row : published_sizes) {
        const auto devices = static_cast<int>(words(row.devices).size());
        int letters = device_count(row.name);
        for (const auto& absent : missing_devices)
            if (std::string_view(absent.table) == row.table && std::string_view(absent.name) == row.name) letters -= absent.count;
        const bool of_both_sources =
            std::string_view(row.table) == "6" && std::string_view(row.devices).find("xrectc") != std::string_view::npos;
        const bool a_mirror = std::string_view(row.table) == "4" && std::string_view(row.name) == "M3";
        if (!of_both_sources && !a_mirror) {
            EXPECT_EQ(devices, letters) << "table " << row.table << " " << row.name;
        }
    }
}

TEST(Tables, GiveTheSizeOfEveryTransistorOfTheChips) {
    const Circuits circuits(as_printed(1));
    const TableComparison compared(circuits);
    for (const auto* chip : {"sa1", "fa1"})
        for (const auto& e : circuits[chip].elements)
            if (e.letter == 'm') {
                EXPECT_TRUE(compared.sized.at(chip).contains(e.name)) << chip << ".cir: no table sizes " << e.name;
            }
}

TEST(Tables, WidthsDistinguishPFromN) {
    const Circuits circuits(as_printed(0));
    for (const auto* chip : {"sa1", "fa1"})
        for (const auto& e : circuits[chip].elements)
            if (e.letter == 'm') {
                const auto& type = circuits[chip].models[static_cast<std::size_t>(e.model)].type;
                EXPECT_EQ(type == "pmos", e.values.at("w") > 5e-6) << chip << ": " << e.name << " is " << type;
            }
}

/// Differences between two devices of the same name, e.g. "m 2 -> 12".
std::vector<std::string> changes(const Element& a, const Element& b) {
    std::vector<std::string> out;
    for (const auto& [name, value] : a.values)
        if (named_value(b, name.c_str(), value) != value)
            out.push_back(fmt::format("{} {} {:g} -> {:g}", a.name, name, value, b.values.at(name)));
    if (a.value != b.value) out.push_back(fmt::format("{} {:g} -> {:g}", a.name, a.value, b.value));
    if (a.waveform.dc != b.waveform.dc) out.push_back(fmt::format("{} dc {:g} -> {:g}", a.name, a.waveform.dc, b.waveform.dc));
    return out;
}

/// Differences of a chip with the intended sizes from the chip with the printed sizes.
std::vector<std::string> as_intended(const char* chip) {
    const Circuits printed(as_printed(1)), intended(as_printed(0));
    std::vector<std::string> out;
    EXPECT_EQ(printed[chip].elements.size(), intended[chip].elements.size());
    for (std::size_t k = 0; k < printed[chip].elements.size(); ++k) {
        const auto& printed_element = printed[chip].elements[k];
        const auto& intended_element = intended[chip].elements[k];
        EXPECT_EQ(printed_element.name, intended_element.name);
        EXPECT_EQ(printed_element.values.size(), intended_element.values.size()) << printed_element.name;
        for (auto& change : changes(printed_element, intended_element)) out.push_back(std::move(change));
    }
    return out;
}

// S9a: the gain of I_C is 2. S10a: I_A is six times as large. Leak and membrane change accordingly.
TEST(Tables, Sa1AsIntendedDiffersInTheStaticAndTheSlowPath) {
    EXPECT_EQ(as_intended("sa1"),
              (std::vector<std::string>{"xrectc.mp1a m 2 -> 4", "xrectc.mn2a m 2 -> 4", "xrectc.mp1b m 2 -> 4", "xrectc.mn2b m 2 -> 4",
                                        "xsummer.mn3b m 2 -> 12", "xcco.cu 1.8e-12 -> 5.4e-12", "ilk dc 5e-12 -> 7e-12"}));
}

// S15: the gain for falling force is 6.
TEST(Tables, Fa1AsIntendedDiffersInTheFallingForcePath) {
    EXPECT_EQ(as_intended("fa1"), (std::vector<std::string>{"xrect.mp1b m 3 -> 6", "xrect.mn2b m 3 -> 6", "xcco.cu 5.4e-12 -> 1.62e-11",
                                                            "ilk dc 5e-12 -> 1e-11"}));
}

/// A subcircuit file in which one number of an array's size has an additional leading 1.
struct ChangedSize {
    std::string file, original, line, text;
};

std::vector<ChangedSize> changed_sizes(const std::string& file) {
    const auto text = read_text_file(test::source_root() + "/circuits/parts/" + file);
    std::vector<ChangedSize> out;
    for (std::size_t at = 0; text && at < text->size(); at = text->find('\n', at) + 1) {
        const auto end = text->find('\n', at);
        const auto line = text->substr(at, end - at);
        if (!line.starts_with('m')) continue;
        for (const auto* what : {" w=", " l=", " m=", " stack="}) {
            const auto place = line.find(what);
            if (place == std::string::npos) continue;
            const auto digit = place + std::string_view(what).size();
            if (line[digit] == '{') continue;  // a parameter of the subcircuit
            auto other = line;
            other.insert(digit, "1");
            auto changed_text = *text;
            out.push_back({file, line, other, changed_text.replace(at, line.size(), other)});
        }
    }
    return out;
}

TEST(Tables, EveryChangedSizeInASubcircuitFileIsDetected) {
    int count = 0;
    for (const auto* file : {"transducer.inc", "transconductor.inc", "trigger.inc", "signal.inc", "oscillator.inc"})
        for (const auto& changed : changed_sizes(file)) {
            const Circuits circuits(as_printed(1), changed.file, changed.text);
            EXPECT_FALSE(TableComparison(circuits).differences.empty())
                << changed.file << ": '" << changed.original << "' as '" << changed.line << "'";
            ++count;
        }
    EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace corpuscle::circuit
