#pragma once
// Runs the decks of test/circuit/decks in Debian's ngspice and in Corpuscle. Decks for ngspice contain the transistor model UICM as
// expressions, which for Corpuscle can be replaced by its built-in device.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "circuit/run_directives.hpp"
#include "core/text/ascii_text.hpp"
#include "support/raw_file.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit::test {

using namespace corpuscle::test;

/// The path of a deck; `name` may begin with a subfolder.
inline std::string deck_path(const std::string& name) { return source_root() + "/test/circuit/decks/" + name + ".cir"; }

/// The names, without .cir, of the decks in a subfolder of test/circuit/decks; "" means the folder itself.
inline std::vector<std::string> deck_names(const std::string& folder = "") {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(source_root() + "/test/circuit/decks/" + folder))
        if (entry.path().extension() == ".cir") out.push_back(entry.path().stem());
    std::sort(out.begin(), out.end());
    return out;
}

/// True if a deck or netlist of this name cannot be compared with this machine's ngspice: later ones than 39 compute the flicker noise of
/// level 1 by another formula, that of NLEV = 2.
inline bool is_another_formula(const std::string& name) {
    static const int version = [] {
        std::FILE* pipe = popen("ngspice --version", "r");
        std::string text(4096, '\0');
        text.resize(std::fread(text.data(), 1, text.size(), pipe));
        pclose(pipe);
        const auto at = text.find("ngspice-");
        return at == text.npos ? 0 : std::atoi(text.c_str() + at + 8);
    }();
    return version > 39 && name.find("mos1_flicker") != name.npos;
}

/// Runs ngspice on the deck with this path and returns its standard output and error. Unless `raw` is empty, ngspice writes its curves to
/// the file of this path. It runs in `folder`.
inline std::string run_ngspice(const std::string& deck, const std::string& raw, const std::string& folder = ".") {
    const auto command = "cd '" + folder + "' && OMP_THREAD_LIMIT=1 ngspice -b " + (raw.empty() ? "" : "-r " + raw + " ") + deck + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string out;
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
    pclose(pipe);
    return out;
}

inline std::shared_ptr<const Circuit> elaborate_netlist(const Result<Netlist>& netlist) {
    EXPECT_TRUE(netlist) << (netlist ? "" : netlist.error().text());
    if (!netlist) return {};
    auto circuit = netlist->elaborate();
    EXPECT_TRUE(circuit) << (circuit ? "" : circuit.error().text());
    return circuit ? std::make_shared<const Circuit>(std::move(*circuit)) : nullptr;
}

inline std::shared_ptr<const Circuit> elaborate_netlist(const std::string& deck) { return elaborate_netlist(Netlist::read(deck)); }

inline RunOutcome run_corpuscle(const Result<Netlist>& netlist) {
    static std::vector<std::shared_ptr<const Circuit>> circuits;  // kept, because an outcome points to the directives of its circuit
    circuits.push_back(elaborate_netlist(netlist));
    if (!circuits.back()) return {};
    auto outcome = run_directives(circuits.back());
    EXPECT_TRUE(outcome) << (outcome ? "" : outcome.error().text());
    return outcome ? *outcome : RunOutcome{};
}
inline RunOutcome run_corpuscle(const std::string& deck) { return run_corpuscle(Netlist::read(deck)); }

/// Converts the name of a curve in a file of ngspice to that in Corpuscle. ngspice writes some quantities that are not voltages as v(...),
/// and keeps capitals.
inline std::string corpuscle_name(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](char c) { return lower(c); });
    for (const std::string_view word : {"transfer_function", "impedance", "noise_"})
        if (name.starts_with("v(") && name.find(word) != std::string::npos) return name.substr(2, name.size() - 3);
    return name;
}

/// The text of a deck in which transistors written as expressions are replaced by the built-in device: subcircuits are omitted, and their
/// instances xm... become transistors m.... The deck's lines "* native: .model ..." define the models to use.
inline std::string with_native_transistors(const std::string& deck) {
    std::istringstream lines(read_file(deck));
    std::string out, line;
    for (bool inside = false; std::getline(lines, line);) {
        if (line.starts_with(".subckt")) inside = true;
        const bool is_omitted = inside;
        if (line.starts_with(".ends")) inside = false;
        if (is_omitted) continue;
        if (line.starts_with("* native: ")) line = line.substr(10);
        if (line.starts_with("xm")) line = line.substr(1);
        out += line + '\n';
    }
    return out;
}

/// The value in the first line "name = value" of a simulator's output; NaN if there is no such line.
inline double logged_number(const std::string& log, const std::string& name) {
    for (std::size_t at = log.find("\n" + name); at != std::string::npos; at = log.find("\n" + name, at + 1)) {
        const auto equals = log.find('=', at + 1);
        const auto between = log.substr(at + 1 + name.size(), equals - at - 1 - name.size());
        if (between.find_first_not_of(' ') == std::string::npos) return std::stod(log.substr(equals + 1));
    }
    return std::nan("");
}

}  // namespace corpuscle::circuit::test
