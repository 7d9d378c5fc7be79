// Arbitrary bytes as an optimization file. Expected: a problem whose variables, cases and limits are finite and fit together, or an error
// with a message and a location.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "optimize/problem.hpp"

using namespace corpuscle;
using namespace corpuscle::optimize;

namespace {

void must(bool ok) {
    if (!ok) std::abort();
}

void check(const OptimizationProblem& p) {
    must(!p.variables.empty() && p.variables.size() <= max_variables);
    must(p.condition_count >= 1 && p.condition_count <= p.cases.size() && p.cases.size() <= max_cases);
    for (const auto& v : p.variables) {
        must(!v.names.empty() && std::isfinite(v.min) && v.min <= v.start && v.start <= v.max);
        for (const double position : {-1.0, 0.0, 0.3, 1.0, 2.0}) {
            const double x = v.value(position);
            must(x >= v.min && x <= v.max && (!v.is_integer || x == std::floor(x)));
        }
        must(v.position(v.start) >= 0 && v.position(v.start) <= 1);
    }
    for (const auto& c : p.cases) must(p.axis_values(p.start(), c).size() == p.sweep->plan().axes.size());
    must(p.required_yield > 0 && p.required_yield <= 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto top = parse_toml(text, "fuzz.toml");
    if (!top) return 0;
    // This fuzzer tests the keys and values of the file. Netlists and recordings have other fuzzers, and forces may be long.
    const auto is_text = [&](std::string_view key) { return top->has(key) && top->get(key)->is_scalar(); };
    const bool known = is_text("afferent") ? top->get("afferent")->text == "sa1" || top->get("afferent")->text == "sa1-macro"
                                           : is_text("netlist") && top->get("netlist")->text == "circuits/bias.cir";
    if (!known || top->has("force") || top->has("rate") || text.find(".t_") != text.npos || text.find("count") != text.npos) return 0;
    const auto problem = read_problem_text(text, "fuzz.toml");
    if (problem)
        check(*problem);
    else
        must(!problem.error().message.empty() && !problem.error().location.file.empty());
    return 0;
}
