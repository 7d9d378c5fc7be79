#include "run/skin/skin_probes.hpp"

#include <fmt/format.h>

namespace corpuscle {

Result<SkinProbes> SkinProbes::make(const Innervation& skin, const SimulationOptions& run) {
    SkinProbes out;
    out.skin_ = &skin;
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) {
        const auto& plan = skin.plan.classes[c];
        const auto count = skin.class_begin[c + 1] - skin.class_begin[c];
        if (count > max_afferents)
            return bad_usage(
                fmt::format("--probe-files works with at most {} afferents of a class, but {} has {} of {}; use fewer, such as "
                            "--population 'grid 4x4'",
                            max_afferents, skin.plan.name, count, plan.name));
        const auto plans = TRY(make_copies(plan.afferent, static_cast<std::uint32_t>(count), plan.distributions, skin.plan.seed));
        for (const auto& afferent : plans) {
            out.afferents_.push_back(make_afferent(afferent, run));
            out.states_.push_back(out.afferents_.back()->start());
            out.values_.emplace_back(out.afferents_.back()->probes().size());
        }
    }
    out.force_.resize(out.afferents_.size());
    return out;
}

std::vector<std::span<const Probe>> SkinProbes::class_probes() const {
    std::vector<std::span<const Probe>> out;
    for (std::size_t c = 0; c < skin_->plan.classes.size(); ++c) {
        const auto first = skin_->class_begin[c];
        out.push_back(first < skin_->class_begin[c + 1] ? afferents_[first]->probes() : std::span<const Probe>{});
    }
    return out;
}

/// Adds the contributions of the sites in ascending order, as FieldForce does.
void SkinProbes::compute_force(const SiteForce& force, std::size_t steps) {
    for (auto& f : force_) f.assign(steps, 0);
    force.for_each_site(skin_->plan.sites.size(), [&](std::size_t s) {
        const double* const at_site = force.data + s * force.stride;
        for (std::size_t c = 0; c < skin_->fields.size(); ++c) {
            const auto& fields = skin_->fields[c];
            for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k) {
                auto& on_afferent = force_[skin_->class_begin[c] + fields.afferent[k]];
                for (std::size_t t = 0; t < steps; ++t) on_afferent[t] += fields.weight[k] * at_site[t];
            }
        }
    });
}

Result<void> SkinProbes::respond(const SiteForce& force, std::size_t steps, ThreadPool& pool) {
    compute_force(force, steps);
    std::vector<Result<void>> results(afferents_.size());
    pool.for_each(afferents_.size(), [&](std::size_t u, unsigned) {
        std::vector<double*> arrays;
        for (auto& values : values_[u]) values.resize(steps), arrays.push_back(values.data());
        std::vector<Spike> spikes;
        ResponseBlock response{spikes, 0, arrays};
        results[u] = afferents_[u]->respond(force_[u], states_[u], response);
    });
    for (auto& result : results)
        if (!result) return result;
    return {};
}

}  // namespace corpuscle
