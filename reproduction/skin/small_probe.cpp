#include "reproduction/skin/small_probe.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/stimulus/touch.hpp"
#include "model/copies.hpp"
#include "model/lane_population.hpp"
#include "skin/contact/contact.hpp"
#include "skin/wave/contact_wave.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t steps = static_cast<std::size_t>((probe_ramp + probe_hold) * probe_rate);

/// The receptive field of one afferent: for each site the weight of each receptor.
using Field = std::map<std::uint32_t, std::vector<double>>;

std::vector<Field> fields_of_class(const Innervation& skin, std::size_t c) {
    const auto& f = skin.fields[c];
    std::vector<Field> out(skin.class_begin[c + 1] - skin.class_begin[c]);
    for (std::uint32_t s = 0; s + 1 < f.begin.size(); ++s)
        for (auto k = f.begin[s]; k < f.begin[s + 1]; ++k) {
            auto& weights = out[f.afferent[k] / f.receptors][s];
            weights.resize(f.receptors);
            weights[f.afferent[k] % f.receptors] = f.weight[k];
        }
    return out;
}

/// The site at which a receptor feels the largest part of a force.
std::uint32_t most_sensitive_site(const Field& field) {
    const auto largest = [](const auto& entry) { return *std::max_element(entry.second.begin(), entry.second.end()); };
    return std::max_element(field.begin(), field.end(), [&](const auto& a, const auto& b) { return largest(a) < largest(b); })->first;
}

/// The sites of a skin by the cell from which they send contact waves.
std::map<WaveCell, std::vector<std::uint32_t>> sites_by_cell(const Sites& sites) {
    const WaveGrid grid(sites);
    std::map<WaveCell, std::vector<std::uint32_t>> out;
    for (std::uint32_t s = 0; s < sites.size(); ++s) out[grid.cell_of(sites.positions[s])].push_back(s);
    return out;
}

/// One press: on which afferent it is watched, where the probe is, and its final force, N.
struct ProbePress {
    std::size_t unit;
    std::uint32_t site;
    double force;
};

/// The probe on the afferents of one class.
class ClassProbe {
    const Innervation& skin_;
    std::vector<Field> fields_;
    std::vector<AfferentPlan> plans_;
    std::size_t receptors_;
    InstructionSet set_;
    std::unique_ptr<ContactWave> wave_;  // null: the class feels no wave
    std::vector<double> wave_at_rest_;   // its saved state
    ThreadPool one_thread_{1};

    ClassProbe(const Innervation& skin, std::size_t c, std::vector<AfferentPlan> plans, InstructionSet set)
        : skin_(skin), fields_(fields_of_class(skin, c)), plans_(std::move(plans)), receptors_(skin.plan.classes[c].receptors()),
          set_(set) {}

public:
    static Result<std::unique_ptr<ClassProbe>> make(const Innervation& skin, std::size_t c) {
        const auto& plan = skin.plan.classes[c];
        const std::size_t count = skin.class_begin[c + 1] - skin.class_begin[c];
        const auto set = TRY(instruction_set());
        auto plans = TRY(make_copies(plan.afferent, static_cast<std::uint32_t>(count), plan.distributions, skin.plan.seed));
        std::unique_ptr<ClassProbe> out(new ClassProbe(skin, c, std::move(plans), set));
        if (plan.wave.speed > 0) {
            out->wave_ = TRY(ContactWave::make(skin, c, 0, count, 1 / probe_rate, set));
            out->wave_at_rest_ = out->wave_->save();
        }
        return out;
    }

    std::size_t size() const { return fields_.size(); }
    const Field& field(std::size_t unit) const { return fields_[unit]; }
    bool has_wave() const { return wave_ != nullptr; }

    /// For each press, whether it evokes a spike.
    Result<std::vector<char>> excites(std::span<const ProbePress> presses) {
        constexpr std::size_t batch = 256;  // presses that are simulated together, to limit the memory
        std::vector<char> out;
        for (std::size_t k = 0; k < presses.size(); k += batch) {
            const auto some = TRY(excites_together(presses.subspan(k, std::min(batch, presses.size() - k))));
            out.insert(out.end(), some.begin(), some.end());
        }
        return out;
    }

private:
    Result<std::unique_ptr<Contact>> contact_at(std::uint32_t site) const {
        const auto& at = skin_.plan.sites.positions[site];
        const std::vector<std::string> settings = {fmt::format("contact.radius={}", probe_radius), fmt::format("contact.x={}", at.x),
                                                   fmt::format("contact.y={}", at.y)};
        const auto overrides = TRY(parse_overrides(settings));
        const auto clock = TRY(make_clock(probe_rate));
        auto contact = TRY(make_contact("sphere", overrides, skin_.plan.sites, clock));
        return std::move(contact.result);
    }

    /// Adds the force of a block on the receptors of an afferent, N, from step `begin` on. felt: [receptor][step].
    void add_block(std::size_t unit, const SiteForce& force, std::size_t begin, std::size_t count, std::span<std::vector<double>> felt) {
        force.for_each_site(skin_.plan.sites.size(), [&](std::size_t s) {
            const auto weights = fields_[unit].find(static_cast<std::uint32_t>(s));
            if (weights == fields_[unit].end()) return;
            for (std::size_t r = 0; r < receptors_; ++r)
                for (std::size_t t = 0; t < count; ++t) felt[r][begin + t] += weights->second[r] * force.data[s * force.stride + t];
        });
        if (!wave_) return;
        wave_->compute(force, force.touched, 0, count, one_thread_);
        if (const double* const wave = wave_->force_on(unit))
            for (auto& f : felt)
                for (std::size_t t = 0; t < count; ++t) f[begin + t] += wave[t];
    }

    /// The force on each receptor of the press's afferent, N over time.
    Result<std::vector<std::vector<double>>> felt(const ProbePress& press) {
        constexpr std::size_t block = WaveSources::max_steps;
        const auto contact = TRY(contact_at(press.site));
        if (wave_) wave_->resume(wave_at_rest_, 0);
        std::vector<std::vector<double>> out(receptors_, std::vector<double>(steps));
        for (std::size_t k = 0; k < steps; k += block) {
            std::vector<double> ramp(std::min(block, steps - k));
            for (std::size_t t = 0; t < ramp.size(); ++t)
                ramp[t] = press.force * ramp_fraction(static_cast<double>(k + t) / probe_rate, 0, probe_ramp);
            const auto force = TRY(contact->press(ramp, static_cast<std::int64_t>(k)));
            add_block(press.unit, force, k, ramp.size(), out);
        }
        return out;
    }

    Result<std::vector<char>> excites_together(std::span<const ProbePress> presses) {
        std::vector<std::vector<double>> forces;  // [press][receptor]: N over time
        std::vector<const AfferentPlan*> plans;
        for (const auto& press : presses) {
            plans.push_back(&plans_[press.unit]);
            for (auto& f : TRY(felt(press))) forces.push_back(std::move(f));
        }
        std::vector<const double*> columns;
        for (const auto& f : forces) columns.push_back(f.data());
        const auto population =
            TRY(make_lane_population({.plans = plans, .size = presses.size(), .forces = receptors_}, {1 / probe_rate}, set_));
        std::vector<Spike> spikes;
        PopulationResponse response{&spikes};
        TRY(population->respond(ForceColumns{columns}, steps, response, one_thread_));
        std::vector<char> out(presses.size());
        for (const auto& s : spikes) out[s.afferent_index] = 1;
        return out;
    }
};

/// Finds the least force of all units together, by bisection on a logarithmic scale.
Result<void> measure_least_forces(ClassProbe& probe, ProbedClass& out) {
    std::vector<double> low(out.units.size(), 1e-6), high(out.units.size(), 10);  // N
    std::vector<ProbePress> presses;
    for (std::size_t k = 0; k < out.units.size(); ++k) presses.push_back({out.units[k], out.site[k], high[k]});
    const auto responds = TRY(probe.excites(presses));
    for (int halving = 0; halving < 10; ++halving) {  // 10 halvings of seven decades: steps of 1.6 %
        for (std::size_t k = 0; k < presses.size(); ++k) presses[k].force = std::sqrt(low[k] * high[k]);
        const auto fires = TRY(probe.excites(presses));
        for (std::size_t k = 0; k < presses.size(); ++k) (fires[k] ? high : low)[k] = presses[k].force;
    }
    for (std::size_t k = 0; k < presses.size(); ++k)
        out.least_force.push_back(responds[k] ? high[k] : std::numeric_limits<double>::quiet_NaN());
    return {};
}

/// The number of sites at which a force on the probe excites an afferent. Outside its receptive field it can feel only waves, which are
/// the same for all sites of a cell.
Result<std::size_t> excitable_sites(ClassProbe& probe, const Sites& sites, std::size_t unit, double force) {
    std::vector<ProbePress> presses;
    std::vector<std::size_t> sites_of_press;  // for each press, the number of sites that it represents
    for (const auto& [site, weights] : probe.field(unit)) presses.push_back({unit, site, force}), sites_of_press.push_back(1);
    if (probe.has_wave())
        for (const auto& [cell, members] : sites_by_cell(sites)) {
            std::vector<std::uint32_t> outside;
            for (const auto s : members)
                if (!probe.field(unit).contains(s)) outside.push_back(s);
            if (!outside.empty()) presses.push_back({unit, outside[outside.size() / 2], force}), sites_of_press.push_back(outside.size());
        }
    const auto fires = TRY(probe.excites(presses));
    std::size_t out = 0;
    for (std::size_t k = 0; k < fires.size(); ++k)
        if (fires[k]) out += sites_of_press[k];
    return out;
}

Result<ProbedClass> probe_class(const Innervation& skin, std::size_t c, std::size_t max_fields) {
    const auto probe = TRY(ClassProbe::make(skin, c));
    ProbedClass out{skin.plan.classes[c].name, {}, {}, {}, {}};
    for (std::size_t unit = 0; unit < probe->size(); ++unit) {
        if (probe->field(unit).empty()) continue;  // it responds to no site
        out.units.push_back(unit), out.site.push_back(most_sensitive_site(probe->field(unit)));
    }
    TRY(measure_least_forces(*probe, out));
    const std::size_t count = std::min(out.units.size(), max_fields);
    for (std::size_t k = 0; k < count; ++k) {
        const auto unit = k * out.units.size() / count;
        if (std::isnan(out.least_force[unit])) continue;
        const auto sites = TRY(excitable_sites(*probe, skin.plan.sites, out.units[unit], 4 * out.least_force[unit]));
        out.field_area.push_back(static_cast<double>(sites) * skin.plan.sites.area);
    }
    return out;
}

}  // namespace

Result<std::vector<ProbedClass>> probe_skin(const Innervation& skin, std::size_t fields_per_class) {
    std::vector<ProbedClass> out;
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) out.push_back(TRY(probe_class(skin, c, fields_per_class)));
    return out;
}

}  // namespace corpuscle
