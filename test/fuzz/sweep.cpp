// Arbitrary bytes as a sweep file. Expected: a sweep with finite values for its work items and with metadata, or an error with a message
// and a location.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "sweep/subject/subject.hpp"

using namespace corpuscle;
using namespace corpuscle::sweeps;

namespace {

void must(bool ok) {
    if (!ok) std::abort();
}

void check(const Error& e) { must(!e.message.empty()); }

void check(const Sweep& s) {
    must(s.item_count >= 1 && !s.metadata.empty());
    for (const auto& f : s.metadata) must(!f.name.empty());
    for (const auto item : {std::int64_t{0}, s.item_count / 2, s.item_count - 1}) {
        const auto values = s.values(item);
        must(values.size() == s.axes.size());
        for (std::size_t k = 0; k < values.size(); ++k) {
            must(std::isfinite(values[k]));
            const auto& words = s.axes[k].labels;
            must(words.empty() || static_cast<std::size_t>(values[k]) < words.size());
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto text = sweeps::read_sweep_text({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    if (!text) {
        must(text.error().location.file == "fuzz.toml");
        return check(text.error()), 0;
    }
    // This fuzzer tests the keys and values of the file. Netlists and recordings have other fuzzers, and forces may be long.
    const auto *afferent = text->get("afferent"), *netlist = text->get("netlist");
    const bool known =
        afferent ? afferent->text == "sa1" || afferent->text == "sa1-macro" : netlist && netlist->text == "circuits/bias.cir";
    if (!known || text->get("force") || text->get("rate") || (afferent && netlist)) return 0;
    for (const auto& s : text->top.settings("set"))
        if (s.name.find(".t_") != std::string::npos) return 0;
    for (const auto& a : text->axes())
        if (a.has("count") && a.get("count")->text.size() > 3) return 0;
    const auto sweep = make_sweep(*text, "/nowhere");
    sweep ? check(**sweep) : check(sweep.error());
    return 0;
}
