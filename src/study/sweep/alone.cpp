// One afferent by itself, and a model that others are held to.

#include <fmt/format.h>
#include <algorithm>

#include "study/afferents.hpp"
#include "study/sweep/subject.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::size_t block_alone = 4096;  // samples

}  // namespace

Result<AloneAnswer> answer_alone(const Afferent& afferent, const FeltForce& force, std::span<const std::size_t> probes, std::size_t every,
                                 const std::function<bool()>& stop) {
    const auto delay = static_cast<std::size_t>(afferent.delay());
    auto samples = force.samples;
    samples.insert(samples.end(), delay, samples.back());
    std::vector<std::vector<double>> shown(probes.empty() ? 0 : afferent.probes().size(), std::vector<double>(block_alone));
    std::vector<double*> rows;
    for (auto& s : shown) rows.push_back(s.data());
    AloneAnswer out;
    out.shown.resize(probes.size());
    std::vector<Spike> spikes;
    auto state = afferent.start();
    for (std::size_t at = 0; at < samples.size(); at += block_alone) {
        if (stop && stop()) return Error{Code::interrupted, "interrupted"};
        const auto count = std::min(block_alone, samples.size() - at);
        Answer answer{spikes, 0, rows};
        if (auto ok = afferent.respond(std::span(samples).subspan(at, count), state, answer); !ok) return ok.error();
        for (std::size_t p = 0; p < probes.size(); ++p)
            for (std::size_t k = 0; k < count; ++k)
                if (at + k >= delay && (at + k - delay) % every == 0) out.shown[p].push_back(static_cast<float>(shown[probes[p]][k]));
    }
    for (const auto& s : spikes)
        if (s.step <= static_cast<std::int64_t>(force.samples.size())) out.spikes.push_back(force.clock.time(s.step, s.offset));
    return out;
}

Result<double> model_says(const Said& model, const ForceMaker& force, const Said& measure) {
    if (force.varies()) return model.wrong("like: the force varies from unit to unit, and a model's answer with it; write numbers");
    const auto plan = plan_any_afferent(model.text, {});
    if (!plan) return model.wrong("like: " + plan.error().sentence);
    const auto& felt = *force.nominal();
    const auto afferent = make_afferent(*plan, {felt.clock.T()});
    const auto answer = answer_alone(*afferent, felt);
    if (!answer) return answer.error();
    AfferentMeasures measures(felt, false, {});
    const auto column = measures.column_of(measure);
    if (!column) return column.error();
    UnitAnswer of_model;
    of_model.spikes = answer->spikes;
    return measures.values(felt, of_model)[*column];
}

}  // namespace corpuscle::sweeps
