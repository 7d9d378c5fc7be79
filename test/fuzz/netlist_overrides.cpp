// Arbitrary lines as overrides and probes of an embedded netlist. Expected: a circuit with finite numbers, or an error with a message.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "circuit/output/saved_quantities.hpp"
#include "circuit/variant/netlist_overrides.hpp"

using namespace corpuscle;
using namespace corpuscle::circuit;

namespace {

void require(bool ok) {
    if (!ok) std::abort();
}

void check(const Circuit& c) {
    for (const auto& e : c.elements) {
        require(std::isfinite(e.value) && std::isfinite(e.waveform.dc));
        for (const auto& [name, value] : e.values) require(std::isfinite(value));
    }
    require(std::isfinite(c.temperature));
}

void resolve(const Circuit& c, std::string_view text) {
    for (const auto& word : split_probes(text)) {
        const auto found = resolve_probe(c, word);
        require(found || !found.error().message.empty());
        if (!found || !*found) require(suggest_probe(c, word).size() < 100'000);
    }
}

}  // namespace

/// Lines with '=' are overrides, all others are probes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    std::vector<ParameterOverride> overrides;
    std::string probes;
    for (std::size_t at = 0; at < text.size() && overrides.size() < 8;) {
        const auto end = std::min(text.find('\n', at), text.size());
        const std::string line(text.substr(at, end - at));
        at = end + 1;
        if (const auto equals = line.find('='); equals != std::string::npos)
            overrides.push_back({"sa1-macro", line.substr(0, equals), line.substr(equals + 1), "--set " + line});
        else
            probes += (probes.empty() ? "" : ",") + line;
    }
    const auto netlist = apply_overrides("sa1-macro", overrides);
    if (!netlist) return require(!netlist.error().message.empty()), 0;
    const auto circuit = netlist->result.elaborate();
    if (!circuit) return require(!circuit.error().message.empty()), 0;
    check(*circuit);
    resolve(*circuit, probes);
    return 0;
}
