#include "skin/skin.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "skin/held.hpp"

namespace corpuscle {
namespace {

/// The units of a class as plans: one for all, or one each where they differ.
Result<std::vector<AfferentPlan>> plans_of(const SkinClass& c, std::size_t first, std::size_t count, std::size_t all, std::uint64_t seed) {
    if (c.spreads.empty()) return std::vector<AfferentPlan>{c.afferent};
    auto drawn = copies_of(c.afferent, static_cast<std::uint32_t>(all), c.spreads, seed);
    if (!drawn || count == all) return drawn;
    const auto from = drawn->begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<AfferentPlan>(from, from + static_cast<std::ptrdiff_t>(count));
}

/// Where a part's range of a class begins: whole tiles.
std::size_t share_begin(std::size_t units, std::uint32_t part, std::uint32_t of) {
    const std::size_t tiles = (units + force_tile - 1) / force_tile;
    return std::min(units, tiles * part / of * force_tile);
}

/// The share of one class; nothing if it has no units of it.
Result<std::optional<SkinCrowd>> crowd_of(const Innervation& skin, std::size_t of, const Run& run, InstructionSet set, SkinShare share,
                                          std::vector<std::shared_ptr<FeltForce>>& felt) {
    const auto& c = skin.plan.classes[of];
    const std::size_t all = skin.first[of + 1] - skin.first[of], first = share_begin(all, share.part, share.of),
                      count = share_begin(all, share.part + 1, share.of) - first;
    if (count == 0) return std::optional<SkinCrowd>{};
    if (!goes_on_lanes(c.afferent, run))
        return bad_input(
            fmt::format("{}: in a skin stand equations without sensor, converter and noise; {} is none", c.name, c.afferent.name));
    const auto plans = plans_of(c, first, count, all, skin.plan.seed);
    if (!plans) return plans.error();
    std::vector<const AfferentPlan*> each;
    for (const auto& p : *plans) each.push_back(&p);
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t u = 0; u < count; ++u) numbers[u] = static_cast<std::uint32_t>(skin.first[of] + first + u);
    auto population = make_population({each, count, numbers}, run, set);
    if (!population) return population.error();
    const auto same = static_cast<std::size_t>(std::find(skin.fields.begin(), skin.fields.end(), skin.fields[of]) - skin.fields.begin());
    const bool as_before = felt[same] && skin.first[same + 1] - skin.first[same] == all;
    felt[of] = as_before ? felt[same] : std::make_shared<FeltForce>(skin.fields[of], first, count, skin.plan.sites.size(), set);
    return std::optional<SkinCrowd>(SkinCrowd{std::move(*population), felt[of], as_before});
}

/// Whether all that touches at one step are numbers.
bool all_numbers(const SiteForce& force, std::span<const std::uint32_t> touched) {
    double sums[8] = {};  // 0, or no number
    const bool in_a_row = force.stride == 1 && !touched.empty() && touched.back() + 1 - touched.front() == touched.size();
    if (const double* const row = force.of + (touched.empty() ? 0 : touched.front()); in_a_row)
        for (std::size_t k = 0; k + 8 <= touched.size(); k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += row[k + l] - row[k + l];
    for (std::size_t k = in_a_row ? touched.size() / 8 * 8 : 0; k < touched.size(); ++k) {
        const double f = force.of[touched[k] * force.stride];
        sums[k % 8] += f - f;
    }
    return std::all_of(std::begin(sums), std::end(sums), [](double x) { return x == 0; });
}

/// The first site with a force that is no number, and when.
std::optional<Error> no_number(const Skin::Held& held, const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t steps) {
    if (steps == 1 && all_numbers(force, touched)) return {};
    for (const auto s : touched)
        if (const auto t = first_not_finite({force.of + s * force.stride, steps}); t < steps)
            return bad_input(fmt::format("{}: the force at site {} is {} at sample {}, not a finite number", held.skin->plan.name,
                                         held.skin->plan.sites.names[s], force.of[s * force.stride + t],
                                         held.step + static_cast<std::int64_t>(t)));
    return {};
}

}  // namespace

/// Which sites are not 0 all through some steps.
std::span<const std::uint32_t> Skin::Held::touched_in(const SiteForce& force, std::size_t at, std::size_t steps) {
    if (!force.all) return force.touched;
    touched.clear();
    for (std::size_t s = 0; s < skin->plan.sites.size(); ++s) {
        const double* f = force.of + s * force.stride + at;
        if (std::any_of(f, f + steps, [](double x) { return x != 0; })) touched.push_back(static_cast<std::uint32_t>(s));
    }
    return touched;
}

/// Some steps at once, at most skin_steps.
Result<void> Skin::Held::feel(const SiteForce& force, std::size_t at, std::size_t steps, std::vector<Spike>& spikes, Pool& pool) {
    const auto felt = touched_in(force, at, steps);
    if (auto wrong = no_number(*this, {force.of + at, force.stride}, felt, steps)) return *wrong;
    left.clear();
    for (auto& c : crowds) {
        if (!c.as_before) c.felt->feel(force, felt, at, steps, pool);
        PopulationAnswer answer{&left};
        if (auto ok = c.population->respond(c.felt->tiles(), steps, answer, pool); !ok) return ok;
        const auto all = static_cast<std::int64_t>(steps * c.population->units());
        work.afferent_steps += all - answer.passed, work.at_rest += answer.passed, work.capped += answer.capped;
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
        auto crowd = crowd_of(*skin, c, run, set, share, felt);
        if (!crowd) return crowd.error();
        if (*crowd) held->crowds.push_back(std::move(**crowd));
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

Result<void> Skin::respond(const SiteForce& force, std::size_t steps, std::vector<Spike>& spikes, Pool& pool) {
    for (std::size_t at = 0; at < steps; at += skin_steps)
        if (auto ok = held_->feel(force, at, std::min(skin_steps, steps - at), spikes, pool); !ok) return ok;
    return {};
}

void Skin::last(std::vector<Spike>& spikes) {
    const auto late = held_->conduction.on_their_way();
    spikes.insert(spikes.end(), late.begin(), late.end());
}

}  // namespace corpuscle
