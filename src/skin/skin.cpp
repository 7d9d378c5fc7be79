#include "skin/skin.hpp"

#include <fmt/format.h>
#include <cmath>

#include "skin/skin_impl.hpp"

namespace corpuscle {
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
    auto population = TRY(make_lane_population({each, count, numbers}, run, set));
    // `same`: the first class with the same receptive fields, perhaps this one; its FieldForce exists only if it is an earlier one.
    const auto same =
        static_cast<std::size_t>(std::find(skin.fields.begin(), skin.fields.end(), skin.fields[class_index]) - skin.fields.begin());
    const bool shares_force = field_forces[same] && skin.class_begin[same + 1] - skin.class_begin[same] == all;
    field_forces[class_index] = shares_force
                                    ? field_forces[same]
                                    : std::make_shared<FieldForce>(skin.fields[class_index], first, count, skin.plan.sites.size(), set);
    return std::optional<ClassSimulation>(ClassSimulation{std::move(population), field_forces[class_index], shares_force});
}

/// True if the force at all touched sites is finite in step 0 of `force`.
bool all_finite(const SiteForce& force, std::span<const std::uint32_t> touched) {
    double sums[8] = {};  // each is 0, or NaN if a force was NaN or infinite
    const bool is_contiguous = force.stride == 1 && !touched.empty() && touched.back() + 1 - touched.front() == touched.size();
    if (const double* const row = force.data + (touched.empty() ? 0 : touched.front()); is_contiguous)
        for (std::size_t k = 0; k + 8 <= touched.size(); k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += row[k + l] - row[k + l];
    for (std::size_t k = is_contiguous ? touched.size() / 8 * 8 : 0; k < touched.size(); ++k) {
        const double f = force.data[touched[k] * force.stride];
        sums[k % 8] += f - f;
    }
    return std::all_of(std::begin(sums), std::end(sums), [](double x) { return x == 0; });
}

/// Returns an error for the first site with a force that is NaN or infinite in `steps` steps of `force`.
Result<void> check_finite(const Skin::Impl& impl, const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t steps) {
    if (steps == 1 && all_finite(force, touched)) return {};
    for (const auto s : touched)
        if (const auto t = first_non_finite({force.data + s * force.stride, steps}); t < steps)
            return bad_input(fmt::format("{}: the force at site {} is {} at sample {}, not a finite number", impl.skin->plan.name,
                                         impl.skin->plan.sites.names[s], force.data[s * force.stride + t],
                                         impl.step + static_cast<std::int64_t>(t)));
    return {};
}

}  // namespace

/// The sites whose force is not 0 in at least one of `steps` steps, from step `at` of the block on.
std::span<const std::uint32_t> Skin::Impl::find_touched(const SiteForce& force, std::size_t at, std::size_t steps) {
    if (!force.reads_all) return force.touched;
    touched.clear();
    for (std::size_t s = 0; s < skin->plan.sites.size(); ++s) {
        const double* f = force.data + s * force.stride + at;
        if (std::any_of(f, f + steps, [](double x) { return x != 0; })) touched.push_back(static_cast<std::uint32_t>(s));
    }
    return touched;
}

/// Simulates `steps` steps, at most skin_steps, from step `at` of the block on.
Result<void> Skin::Impl::run_steps(const SiteForce& force, std::size_t at, std::size_t steps, std::vector<Spike>& spikes,
                                   ThreadPool& pool) {
    const auto touched_sites = find_touched(force, at, steps);
    TRY(check_finite(*this, {force.data + at, force.stride}, touched_sites, steps));
    fired.clear();
    for (auto& c : classes) {
        if (!c.shares_force) c.field_force->compute(force, touched_sites, at, steps, pool);
        PopulationResponse response{&fired};
        TRY(c.population->respond(c.field_force->tiles(), steps, response, pool));
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

}  // namespace corpuscle
