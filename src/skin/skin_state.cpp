// Saves and restores the state of a skin as bytes.

#include <fmt/format.h>
#include <array>

#include "core/bytes.hpp"
#include "skin/skin_impl.hpp"

namespace corpuscle {
namespace {

/// A hash of the skin that a state belongs to: its afferents, their receptive fields and the simulation options.
std::uint64_t fingerprint(const Skin::Impl& impl) {
    Fnv1a all;
    const auto& skin = *impl.skin;
    all.add(impl.run.dt), all.add(static_cast<int>(impl.run.method)), all.add(impl.run.spikes_on_samples);
    all.add(impl.part.index), all.add(impl.part.count), all.add(skin.plan.seed), all.add(skin.plan.sites.size());
    for (const auto& c : skin.plan.classes) {
        all.add(c.afferent.composition());
        for (const double v : c.afferent.values) all.add(v);
        for (const auto& s : c.distributions) all.add(s.parameter), all.add(s.deviation);
    }
    for (const auto& u : skin.afferents) all.add(u.class_index), all.add(u.delay);
    for (const auto& f : skin.fields) {
        for (const auto b : f.begin) all.add(b);
        for (const auto w : f.weight) all.add(w);
    }
    return all.value;
}

/// A spike in transit, as it is saved: without padding between its members.
struct PackedSpike {
    std::int64_t step;
    double offset;
    std::uint64_t afferent;
};

/// Checks the beginning of a saved state, and the checksum at its end, which a state of version 1 does not have.
Result<void> check_frame(ByteReader& in, std::span<const std::byte> saved) {
    const auto version = read_magic(in, "corpsk");
    if (!version) return bad_input("not a saved state of a skin: it does not begin with 'corpsk'");
    if (*version == '1') return {};
    if (*version != '2')
        return bad_input(
            "a saved state of a skin has a later version than 2, the latest that this program can read; start from the beginning, "
            "or use the program that saved it");
    if (in.rest().size() < sizeof(std::uint64_t)) return bad_input("a saved state of a skin is truncated; start from the beginning");
    if (in.check_checksum(saved)) return {};
    return bad_input("a saved state of a skin is damaged: its checksum is wrong; start from the beginning");
}

}  // namespace

std::vector<std::byte> Skin::save() const {
    ByteWriter<std::vector<std::byte>> out;
    const auto& h = *impl_;
    out.put_raw("corpsk2\n", 8);
    out.put(fingerprint(h), h.step, h.stats.afferent_steps, h.stats.skipped_steps, h.stats.spikes, h.stats.truncated_steps);
    for (const auto& c : h.classes) out.put(c.population->save());
    std::vector<PackedSpike> in_transit;
    for (const auto& s : h.conduction.in_transit()) in_transit.push_back({s.step, s.offset, s.afferent_index});
    out.put(in_transit);
    out.put_checksum();
    return out.take();
}

Result<void> Skin::resume(std::span<const std::byte> saved) {
    auto& h = *impl_;
    ByteReader in(saved);
    TRY(check_frame(in, saved));
    std::uint64_t saved_fingerprint = 0;
    std::int64_t step = 0;
    SkinStats stats;
    const auto damaged = bad_input("a saved state of a skin is damaged or truncated; start from the beginning");
    if (!in.get(saved_fingerprint, step)) return damaged;
    if (saved_fingerprint != fingerprint(h))
        return bad_input(
            fmt::format("a saved state belongs to another skin than {}: population, parameters, seed, rate and method must be those "
                        "it was saved with",
                        h.skin->plan.name));
    if (!in.get(stats.afferent_steps, stats.skipped_steps, stats.spikes, stats.truncated_steps) || step < 0) return damaged;
    stats.steps = step;
    std::vector<std::vector<double>> states(h.classes.size());
    for (auto& s : states)
        if (!in.get(s)) return damaged;
    std::vector<PackedSpike> packed;
    if (!in.get(packed) || !in.ended()) return damaged;
    std::vector<Spike> in_transit;
    for (const auto& s : packed) {
        in_transit.push_back({s.step, s.offset, static_cast<std::uint32_t>(s.afferent)});
        if (s.afferent >= h.skin->afferents.size() || !h.conduction.can_be_in_transit(in_transit.back(), step - 1)) return damaged;
    }
    for (std::size_t c = 0; c < states.size(); ++c)
        if (auto ok = h.classes[c].population->resume(states[c]); !ok || h.classes[c].population->step() != step) return damaged;
    h.conduction.restore(in_transit, step - 1);
    h.step = step, h.stats = stats;
    return {};
}

}  // namespace corpuscle
