// Arbitrary text as names, settings and parameter distributions. Expected: an afferent or stimulus that runs and stays finite, valid
// copies, or an error with a message.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/stimulus/stimuli.hpp"
#include "model/copies.hpp"

using namespace corpuscle;

namespace {

/// Lines of the text: the afferent, the stimulus, then settings.
std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at <= text.size() && lines.size() < 12;) {
        const auto end = std::min(text.find('\n', at), text.size());
        lines.emplace_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

void run(const AfferentPlan& plan, ForceSource& source, Method method) {
    if (source.clock().T() / plan.value("substep").value_or(1) > 1e3) return;  // valid but slow
    const auto afferent = make_afferent(plan, {source.clock().T(), method, false});
    auto state = afferent->start();
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    Frames block(1, 256);
    for (int k = 0; k < 4; ++k) {
        if (auto ok = source.read(block); !ok) return;
        if (const auto ok = afferent->respond({block.force[0].data(), block.count}, state, response); !ok) {
            if (ok.error().message.empty()) std::abort();
            return;
        }
    }
    for (const auto& s : spikes)
        if (!(s.offset > 0 && s.offset <= 1)) std::abort();
    for (const double x : state.values)
        if (std::isnan(x)) std::abort();
}

/// The same settings as parameter distributions. Expected: valid copies, or an error with a message.
void make_random_copies(std::string_view text, std::span<const ParameterOverride> overrides) {
    const auto plan = plan_afferent(text);
    if (!plan) return;
    const auto spreads = distributions_for(*plan, overrides);
    if (!spreads) return spreads.error().message.empty() ? std::abort() : void();
    const auto copies = make_copies(*plan, 3, spreads->result, 1);
    if (!copies) return copies.error().message.empty() ? std::abort() : void();
    for (const auto& copy : *copies) {
        if (!check_plan(copy)) std::abort();
        for (std::size_t k = 0; k < copy.values.size(); ++k)
            if (!check_range(copy.name, (*copy.parameters)[k].info, copy.values[k])) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto lines = lines_of({reinterpret_cast<const char*>(data), size});
    std::vector<ParameterOverride> overrides;
    for (std::size_t k = 2; k < lines.size(); ++k)
        if (auto parsed = parse_override(lines[k])) overrides.push_back(std::move(*parsed));
    const auto plan = plan_afferent(lines[0], overrides);
    if (!plan && plan.error().message.empty()) std::abort();
    make_random_copies(lines[0], overrides);
    if (lines.size() < 2 || !is_stimulus(lines[1])) return 0;
    const auto source = make_stimulus(lines[1], overrides, 1e3, 1);
    if (!source && source.error().message.empty()) std::abort();
    if (plan && source) run(plan->result, *source->result, size % 2 ? Method::exact : Method::backward_euler);
    return 0;
}
