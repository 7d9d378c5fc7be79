#include "skin/skin.hpp"

#include <fmt/format.h>

#include "core/bytes.hpp"
#include "skin/conduction.hpp"
#include "skin/field_force.hpp"
#include "skin/shear_force.hpp"
#include "skin/wave/contact_wave.hpp"

namespace corpuscle {

/// The afferents of one class and the force on them.
struct ClassSimulation {
    std::unique_ptr<LanePopulation> population;
    std::shared_ptr<FieldForce> field_force;
    bool shares_force = false;  ///< true: an earlier class has the same receptive fields and computes the normal force for both
    ShearForce shear;
    std::unique_ptr<ContactWave> wave = {};  ///< null: the class feels none

    /// The force on its afferents in `steps` steps from step `at` of the block on, without waves.
    ForceTiles<double> direct_force(const SiteForce& all, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps,
                                    ThreadPool& pool) {
        if (all.has_shear() && shear.is_tuned()) return shear.add(*field_force, all, touched, at, steps, pool);
        // With shear, an earlier class with the same receptive fields may have replaced the normal force.
        if (!shares_force || all.has_shear()) field_force->compute(all, touched, at, steps, pool);
        return field_force->tiles();
    }
    ForceTiles<double> force(const SiteForce& all, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps,
                             ThreadPool& pool) {
        const auto direct = direct_force(all, touched, at, steps, pool);
        return wave ? wave->add(direct, all, touched, at, steps, pool) : direct;
    }
};

struct Skin::Impl {
    Impl(std::shared_ptr<const Innervation> skin, const SimulationOptions& run, SkinPart part)
        : skin(std::move(skin)), run(run), part(part), conduction(*this->skin, run.dt) {}

    std::shared_ptr<const Innervation> skin;
    SimulationOptions run;
    SkinPart part;
    std::vector<ClassSimulation> classes;
    Conduction conduction;
    std::vector<Spike> fired;            // spikes fired in the skin during the call of run_steps()
    std::vector<std::uint32_t> touched;  // result of find_touched()
    std::int64_t step = 0;               // number of samples simulated so far
    SkinStats stats;

    std::span<const std::uint32_t> find_touched(const SiteForce&, std::size_t at, std::size_t steps);
    Result<void> run_steps(const SiteForce&, std::size_t at, std::size_t steps, std::vector<Spike>&, ThreadPool&);
};

namespace {

/// The plans of afferents [first, first + count) of a class that has `all` afferents: a single plan if all are equal, otherwise one for
/// each.
Result<std::vector<AfferentPlan>> plans_of(const SkinClass& c, std::size_t first, std::size_t count, std::size_t all, std::uint64_t seed) {
    if (c.distributions.empty()) return std::vector<AfferentPlan>{c.afferent};
    auto sampled = make_copies(c.afferent, static_cast<std::uint32_t>(all), c.distributions, seed);
    if (!sampled || count == all) return sampled;
    const auto from = sampled->begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<AfferentPlan>(from, from + static_cast<std::ptrdiff_t>(count));
}

/// The index of the first afferent of part `part` (from 0) of `parts` parts of a class with `size` afferents. Parts consist of whole tiles.
std::size_t part_begin(std::size_t size, std::uint32_t part, std::uint32_t parts) {
    const std::size_t tiles = (size + tile_width - 1) / tile_width;
    return std::min(size, tiles * part / parts * tile_width);
}

/// The part of one class that this process simulates; nullopt if that part has no afferents. `field_forces` has one element for each class;
/// this function sets that of `class_index`. Classes with equal receptive fields share one FieldForce.
Result<std::optional<ClassSimulation>> make_class(const Innervation& skin, std::size_t class_index, const SimulationOptions& run,
                                                  InstructionSet set, SkinPart part,
                                                  std::vector<std::shared_ptr<FieldForce>>& field_forces) {
    const auto& c = skin.plan.classes[class_index];
    const std::size_t all = skin.class_begin[class_index + 1] - skin.class_begin[class_index],
                      first = part_begin(all, part.index, part.count), count = part_begin(all, part.index + 1, part.count) - first;
    if (count == 0) return std::optional<ClassSimulation>{};
    if (!can_use_lanes(c.afferent, run))
        return bad_input(fmt::format("{}: {} cannot be used in a skin, which needs model equations without sensor, converter and noise",
                                     c.name, c.afferent.name));
    const auto plans = TRY(plans_of(c, first, count, all, skin.plan.seed));
    std::vector<const AfferentPlan*> each;
    for (const auto& p : plans) each.push_back(&p);
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t u = 0; u < count; ++u) numbers[u] = static_cast<std::uint32_t>(skin.class_begin[class_index] + first + u);
    auto population =
        TRY(make_lane_population({.plans = each, .size = count, .afferent_numbers = numbers, .forces = c.receptors()}, run, set));
    // `same`: the first class with the same receptive fields, perhaps this one; its FieldForce exists only if it is an earlier one.
    const auto same =
        static_cast<std::size_t>(std::find(skin.fields.begin(), skin.fields.end(), skin.fields[class_index]) - skin.fields.begin());
    const bool shares_force = field_forces[same] && skin.class_begin[same + 1] - skin.class_begin[same] == all;
    field_forces[class_index] =
        shares_force ? field_forces[same] : std::make_shared<FieldForce>(skin.fields[class_index], first, count, set);
    ClassSimulation out{std::move(population), field_forces[class_index], shares_force,
                        ShearForce(c.direction, std::span(skin.afferents).subspan(numbers[0], count), c.receptors())};
    if (c.wave.speed > 0) out.wave = TRY(ContactWave::make(skin, class_index, first, count, run.dt, set));
    return std::optional<ClassSimulation>(std::move(out));
}

/// True if this component of a force is finite at all touched sites in its first step.
bool all_finite(const double* component, std::size_t stride, std::span<const std::uint32_t> touched) {
    double sums[8] = {};  // each is 0, or NaN if a force was NaN or infinite
    const bool is_contiguous = stride == 1 && !touched.empty() && touched.back() + 1 - touched.front() == touched.size();
    if (const double* const row = component + (touched.empty() ? 0 : touched.front()); is_contiguous)
        for (std::size_t k = 0; k + 8 <= touched.size(); k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += row[k + l] - row[k + l];
    for (std::size_t k = is_contiguous ? touched.size() / 8 * 8 : 0; k < touched.size(); ++k) {
        const double f = component[touched[k] * stride];
        sums[k % 8] += f - f;
    }
    return std::all_of(std::begin(sums), std::end(sums), [](double x) { return x == 0; });
}

/// Returns an error for the first site with a force that is NaN or infinite in `steps` steps of `force`, from step `at` on.
Result<void> check_finite(const Skin::Impl& impl, const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at,
                          std::size_t steps) {
    Result<void> out;
    force.for_each_component([&](const double* component) {
        const double* const from = component + at;
        if (!out || (steps == 1 && all_finite(from, force.stride, touched))) return;
        for (const auto s : touched) {
            const auto t = first_non_finite({from + s * force.stride, steps});
            if (t == steps) continue;
            const auto* const name = component == force.data ? "force" : component == force.shear_x ? "shear along x" : "shear along y";
            out = bad_input(fmt::format("{}: the {} at site {} is {} at sample {}, not a finite number", impl.skin->plan.name, name,
                                        impl.skin->plan.sites.names[s], from[s * force.stride + t],
                                        impl.step + static_cast<std::int64_t>(t)));
            return;
        }
    });
    return out;
}

// For saved states.

/// A hash of the skin that a state belongs to: its afferents, their receptive fields and the simulation options.
std::uint64_t fingerprint(const Skin::Impl& impl) {
    Fnv1a all;
    const auto& skin = *impl.skin;
    all.add(impl.run.dt), all.add(static_cast<int>(impl.run.method)), all.add(impl.run.spikes_on_samples);
    all.add(impl.part.index), all.add(impl.part.count), all.add(skin.plan.seed), all.add(skin.plan.sites.size());
    for (const auto& c : skin.plan.classes) {
        all.add(c.afferent.composition());
        for (const double v : c.afferent.values) all.add(v);
        for (const auto& s : c.distributions) all.add(s.parameter), all.add(s.deviation), s.factor ? all.add(*s.factor) : void();
        if (const auto& w = c.wave; w.speed > 0) all.add(w.speed), all.add(w.decay), all.add(w.radius), all.add(w.gain), all.add(w.corner);
    }
    for (const auto& u : skin.afferents) {
        all.add(u.class_index), all.add(u.delay);
        if (const double gain = skin.plan.classes[u.class_index].direction.gain; gain != 0) all.add(gain), all.add(u.direction);
    }
    for (const auto& f : skin.fields) {
        for (const auto b : f.begin) all.add(b);
        for (const auto w : f.weight) all.add(w);
        if (f.receptors > 1) all.add(f.receptors);
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
    if (*version != '2' && *version != '3')
        return bad_input(
            "a saved state of a skin has a later version than 3, the latest that this program can read; start from the beginning, "
            "or use the program that saved it");
    if (in.rest().size() < sizeof(std::uint64_t)) return bad_input("a saved state of a skin is truncated; start from the beginning");
    if (in.check_checksum(saved)) return {};
    return bad_input("a saved state of a skin is damaged: its checksum is wrong; start from the beginning");
}

}  // namespace

/// The sites whose force is not 0 in at least one of `steps` steps, from step `at` of the block on.
std::span<const std::uint32_t> Skin::Impl::find_touched(const SiteForce& force, std::size_t at, std::size_t steps) {
    if (!force.reads_all) return force.touched;
    touched.clear();
    for (std::size_t s = 0; s < skin->plan.sites.size(); ++s) {
        bool is_touched = false;
        force.for_each_component([&](const double* component) {
            const double* f = component + s * force.stride + at;
            is_touched = is_touched || std::any_of(f, f + steps, [](double x) { return x != 0; });
        });
        if (is_touched) touched.push_back(static_cast<std::uint32_t>(s));
    }
    return touched;
}

/// Simulates `steps` steps, at most skin_steps, from step `at` of the block on.
Result<void> Skin::Impl::run_steps(const SiteForce& force, std::size_t at, std::size_t steps, std::vector<Spike>& spikes,
                                   ThreadPool& pool) {
    const auto touched_sites = find_touched(force, at, steps);
    TRY(check_finite(*this, force, touched_sites, at, steps));
    fired.clear();
    for (auto& c : classes) {
        PopulationResponse response{&fired};
        TRY(c.population->respond(c.force(force, touched_sites, at, steps, pool), steps, response, pool));
        const auto all = static_cast<std::int64_t>(steps * c.population->size());
        stats.afferent_steps += all - response.skipped_steps, stats.skipped_steps += response.skipped_steps,
            stats.truncated_steps += response.truncated_steps;
    }
    step += static_cast<std::int64_t>(steps), stats.steps += static_cast<std::int64_t>(steps);
    const std::size_t before = spikes.size();
    conduction.deliver(fired, step - 1, spikes);  // step - 1: the last simulated sample
    stats.spikes += static_cast<std::int64_t>(spikes.size() - before);
    return {};
}

Result<std::unique_ptr<Skin>> Skin::make(const std::shared_ptr<const Innervation>& skin, const SimulationOptions& run, InstructionSet set,
                                         SkinPart part) {
    auto impl = std::make_unique<Impl>(skin, run, part);
    std::vector<std::shared_ptr<FieldForce>> field_forces(skin->plan.classes.size());
    for (std::size_t c = 0; c < skin->plan.classes.size(); ++c) {
        auto simulation = TRY(make_class(*skin, c, run, set, part, field_forces));
        if (simulation) impl->classes.push_back(std::move(*simulation));
    }
    impl->touched.reserve(skin->plan.sites.size());
    return std::unique_ptr<Skin>(new Skin(std::move(impl)));
}

Skin::Skin(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Skin::~Skin() = default;

const Innervation& Skin::innervation() const { return *impl_->skin; }
std::size_t Skin::sites() const { return impl_->skin->plan.sites.size(); }
std::int64_t Skin::step() const { return impl_->step; }
const SkinStats& Skin::stats() const { return impl_->stats; }

Result<void> Skin::respond(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes, ThreadPool& pool) {
    for (std::size_t at = 0; at < steps; at += skin_steps) TRY(impl_->run_steps(force, at, std::min(skin_steps, steps - at), spikes, pool));
    return {};
}

void Skin::finish(std::vector<Spike>& spikes) {
    const auto in_transit = impl_->conduction.in_transit();
    spikes.insert(spikes.end(), in_transit.begin(), in_transit.end());
}

std::vector<std::byte> Skin::save() const {
    ByteWriter<std::vector<std::byte>> out;
    const auto& h = *impl_;
    out.put_raw("corpsk3\n", 8);
    out.put(fingerprint(h), h.step, h.stats.afferent_steps, h.stats.skipped_steps, h.stats.spikes, h.stats.truncated_steps);
    for (const auto& c : h.classes) out.put(c.population->save());
    for (const auto& c : h.classes)
        if (c.wave) out.put(c.wave->save());
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
    for (auto& c : h.classes)
        if (std::vector<double> wave; c.wave && !(in.get(wave) && c.wave->resume(wave, step))) return damaged;
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
