// Any lines as what is set and shown of a netlist that the program carries: a circuit whose numbers are numbers, or an error with a sentence.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "circuit/netlist_overrides.hpp"
#include "circuit/resolve_probe.hpp"

using namespace corpuscle;
using namespace corpuscle::circuit;

namespace {

void must(bool ok) {
    if (!ok) std::abort();
}

void check(const Circuit& c) {
    for (const auto& e : c.elements) {
        must(std::isfinite(e.value) && std::isfinite(e.waveform.dc));
        for (const auto& [name, value] : e.values) must(std::isfinite(value));
    }
    must(std::isfinite(c.temperature));
}

void show(const Circuit& c, std::string_view text) {
    for (const auto& word : split_probes(text)) {
        const auto found = resolve_probe(c, word);
        must(found || !found.error().message.empty());
        if (!found || !*found) must(suggest_probe(c, word).size() < 100'000);
    }
}

}  // namespace

/// Lines with '=' are set, all others shown.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    std::vector<NetlistOverride> knobs;
    std::string shown;
    for (std::size_t at = 0; at < text.size() && knobs.size() < 8;) {
        const auto end = std::min(text.find('\n', at), text.size());
        const std::string line(text.substr(at, end - at));
        at = end + 1;
        if (const auto equals = line.find('='); equals != std::string::npos)
            knobs.push_back({line.substr(0, equals), line.substr(equals + 1), "--set " + line});
        else
            shown += (shown.empty() ? "" : ",") + line;
    }
    const auto netlist = apply_overrides("sa1-macro", knobs);
    if (!netlist) return must(!netlist.error().message.empty()), 0;
    const auto circuit = netlist->elaborate();
    if (!circuit) return must(!circuit.error().message.empty()), 0;
    check(*circuit);
    show(*circuit, shown);
    return 0;
}
