#include "skin/skin.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "skin/held.hpp"

namespace corpuscle {
namespace {

/// The afferents of a class as plans: one for all, or one for each if they differ.
Result<std::vector<AfferentPlan>> plans_of(const SkinClass& c, std::size_t first, std::size_t count, std::size_t all, std::uint64_t seed) {
    if (c.spreads.empty()) return std::vector<AfferentPlan>{c.afferent};
    auto sampled = copies_of(c.afferent, static_cast<std::uint32_t>(all), c.spreads, seed);
    if (!sampled || count == all) return sampled;
    const auto from = sampled->begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<AfferentPlan>(from, from + static_cast<std::ptrdiff_t>(count));
}

/// The index of the first afferent of a part; parts consist of whole tiles.
std::size_t part_begin(std::size_t size, std::uint32_t part, std::uint32_t of) {
    const std::size_t tiles = (size + force_tile - 1) / force_tile;
    return std::min(size, tiles * part / of * force_tile);
}

/// The part of one class that this process simulates; nothing if it has no afferents.
Result<std::optional<SkinCrowd>> make_class(const Innervation& skin, std::size_t class_index, const Run& run, InstructionSet set,
                                            SkinShare share, std::vector<std::shared_ptr<FeltForce>>& felt) {
    const auto& c = skin.plan.classes[class_index];
    const std::size_t all = skin.first[class_index + 1] - skin.first[class_index], first = part_begin(all, share.part, share.of),
                      count = part_begin(all, share.part + 1, share.of) - first;
    if (count == 0) return std::optional<SkinCrowd>{};
    if (!goes_on_lanes(c.afferent, run))
        return bad_input(fmt::format("{}: a skin needs model equations without sensor, converter and noise; {} is not of this kind", c.name,
                                     c.afferent.name));
    const auto plans = plans_of(c, first, count, all, skin.plan.seed);
    if (!plans) return plans.error();
    std::vector<const AfferentPlan*> each;
    for (const auto& p : *plans) each.push_back(&p);
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t u = 0; u < count; ++u) numbers[u] = static_cast<std::uint32_t>(skin.first[class_index] + first + u);
    auto population = make_population({each, count, numbers}, run, set);
    if (!population) return population.error();
    const auto same =
        static_cast<std::size_t>(std::find(skin.fields.begin(), skin.fields.end(), skin.fields[class_index]) - skin.fields.begin());
    const bool as_before = felt[same] && skin.first[same + 1] - skin.first[same] == all;
    felt[class_index] =
        as_before ? felt[same] : std::make_shared<FeltForce>(skin.fields[class_index], first, count, skin.plan.sites.size(), set);
    return std::optional<SkinCrowd>(SkinCrowd{std::move(*population), felt[class_index], as_before});
}

/// True if all touched sites have a finite force at one step.
bool all_finite(const SiteForce& force, std::span<const std::uint32_t> touched) {
    double sums[8] = {};  // 0, or NaN
    const bool is_contiguous = force.stride == 1 && !touched.empty() && touched.back() + 1 - touched.front() == touched.size();
    if (const double* const row = force.of + (touched.empty() ? 0 : touched.front()); is_contiguous)
        for (std::size_t k = 0; k + 8 <= touched.size(); k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += row[k + l] - row[k + l];
    for (std::size_t k = is_contiguous ? touched.size() / 8 * 8 : 0; k < touched.size(); ++k) {
        const double f = force.of[touched[k] * force.stride];
        sums[k % 8] += f - f;
    }
    return std::all_of(std::begin(sums), std::end(sums), [](double x) { return x == 0; });
}

/// An error for the first site with a force that is not finite, and its sample.
std::optional<Error> check_finite(const Skin::Held& held, const SiteForce& force, std::span<const std::uint32_t> touched,
                                  std::size_t steps) {
    if (steps == 1 && all_finite(force, touched)) return {};
    for (const auto s : touched)
        if (const auto t = first_non_finite({force.of + s * force.stride, steps}); t < steps)
            return bad_input(fmt::format("{}: the force at site {} is {} at sample {}, not a finite number", held.skin->plan.name,
                                         held.skin->plan.sites.names[s], force.of[s * force.stride + t],
                                         held.step + static_cast<std::int64_t>(t)));
    return {};
}

}  // namespace

/// The sites that are not 0 during some steps.
std::span<const std::uint32_t> Skin::Held::touched_in(const SiteForce& force, std::size_t at, std::size_t steps) {
    if (!force.all) return force.touched;
    touched.clear();
    for (std::size_t s = 0; s < skin->plan.sites.size(); ++s) {
        const double* f = force.of + s * force.stride + at;
        if (std::any_of(f, f + steps, [](double x) { return x != 0; })) touched.push_back(static_cast<std::uint32_t>(s));
    }
    return touched;
}

/// Simulates some steps at once, at most skin_steps.
Result<void> Skin::Held::feel(const SiteForce& force, std::size_t at, std::size_t steps, std::vector<Spike>& spikes, ThreadPool& pool) {
    const auto sites = touched_in(force, at, steps);
    if (auto error = check_finite(*this, {force.of + at, force.stride}, sites, steps)) return *error;
    left.clear();
    for (auto& c : crowds) {
        if (!c.as_before) c.felt->feel(force, sites, at, steps, pool);
        PopulationAnswer response{&left};
        if (auto ok = c.population->respond(c.felt->tiles(), steps, response, pool); !ok) return ok;
        const auto all = static_cast<std::int64_t>(steps * c.population->units());
        work.afferent_steps += all - response.passed, work.at_rest += response.passed, work.capped += response.capped;
    }
    step += static_cast<std::int64_t>(steps), work.steps += static_cast<std::int64_t>(steps);
    const std::size_t before = spikes.size();
    conduction.carry(left, step - 1, spikes);
    work.spikes += static_cast<std::int64_t>(spikes.size() - before);
    return {};
}

Result<std::unique_ptr<Skin>> Skin::make(const std::shared_ptr<const Innervation>& skin, const Run& run, InstructionSet set,
                                         SkinShare share) {
    auto held = std::make_unique<Held>(skin, run, share);
    std::vector<std::shared_ptr<FeltForce>> felt(skin->plan.classes.size());
    for (std::size_t c = 0; c < skin->plan.classes.size(); ++c) {
        auto simulation = make_class(*skin, c, run, set, share, felt);
        if (!simulation) return simulation.error();
        if (*simulation) held->crowds.push_back(std::move(**simulation));
    }
    held->touched.reserve(skin->plan.sites.size());
    return std::unique_ptr<Skin>(new Skin(std::move(held)));
}

Skin::Skin(std::unique_ptr<Held> held) : held_(std::move(held)) {}
Skin::~Skin() = default;

const Innervation& Skin::innervation() const { return *held_->skin; }
std::size_t Skin::sites() const { return held_->skin->plan.sites.size(); }
std::int64_t Skin::step() const { return held_->step; }
const SkinWork& Skin::work() const { return held_->work; }

Result<void> Skin::respond(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes, ThreadPool& pool) {
    for (std::size_t at = 0; at < steps; at += skin_steps)
        if (auto ok = held_->feel(force, at, std::min(skin_steps, steps - at), spikes, pool); !ok) return ok;
    return {};
}

void Skin::last(std::vector<Spike>& spikes) {
    const auto in_transit = held_->conduction.on_their_way();
    spikes.insert(spikes.end(), in_transit.begin(), in_transit.end());
}

}  // namespace corpuscle
