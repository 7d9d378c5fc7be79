// Afferents on lanes answer as they do one by one: to the bit in double, whatever the instruction set, the threads, the blocks.

#include "model/population.hpp"

#include <fmt/format.h>

#include <cmath>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::force, test::sure;

std::span<const InstructionSet> lane_sets() { return instruction_sets().subspan(1); }

/// A population's plans, and the force of each unit.
struct Case {
    std::vector<AfferentPlan> plans;  // one, or one a unit
    std::vector<std::vector<double>> force;
    Run run;
    std::size_t units() const { return force.size(); }
    const AfferentPlan& plan(std::size_t u) const { return plans[plans.size() == 1 ? 0 : u]; }
};

std::vector<Spike> one_by_one(const Case& c) {
    std::vector<Spike> out;
    for (std::size_t u = 0; u < c.units(); ++u) {
        Answer answer{out, static_cast<std::uint32_t>(u)};
        const auto a = make_afferent(c.plan(u), c.run);
        auto state = a->start();
        if (auto ok = a->respond(c.force[u], state, answer); !ok) throw std::runtime_error(ok.error().text());
    }
    std::sort(out.begin(), out.end());
    return out;
}

struct How {
    InstructionSet set = InstructionSet::baseline;
    Precision precision = Precision::in_double;
    std::vector<std::size_t> blocks = {4096};
    Pool* pool = nullptr;
};

std::unique_ptr<Population> population(const Case& c, const How& how) {
    std::vector<const AfferentPlan*> plans;
    for (const auto& p : c.plans) plans.push_back(&p);
    return sure(make_population({plans, c.units(), {}, how.precision}, c.run, how.set));
}

/// Answers in blocks; feed(first, count, answer) hands each one in.
template <class Feed>
std::vector<Spike> in_blocks(const Case& c, const How& how, const Feed& feed) {
    const auto p = population(c, how);
    Pool own(1);
    std::vector<Spike> out;
    const std::size_t samples = c.force[0].size();
    for (std::size_t k = 0, n = 0; k < samples; ++n) {
        const auto size = std::min(how.blocks[n % how.blocks.size()], samples - k);
        PopulationAnswer answer{&out};
        if (auto ok = feed(*p, k, size, answer, how.pool ? *how.pool : own); !ok) throw std::runtime_error(ok.error().text());
        k += size;
    }
    return out;
}

std::vector<Spike> on_lanes(const Case& c, const How& how) {
    return in_blocks(c, how, [&](Population& p, std::size_t first, std::size_t count, PopulationAnswer& answer, Pool& pool) {
        std::vector<const double*> columns;
        for (const auto& f : c.force) columns.push_back(f.data() + first);
        return p.respond(ForceColumns{columns}, count, answer, pool);
    });
}

std::vector<std::string> every_chain() {
    std::vector<std::string> names;
    for (const auto& r : receptor_cards())
        for (const auto& n : neuron_cards()) names.push_back(fmt::format("{}+{}", r.name, n.name));
    return names;
}

/// Forces that differ from unit to unit, brisk enough for all of them.
std::vector<std::vector<double>> forces(std::size_t units, double rate, double seconds) {
    auto press = force("press+noise+chirp", {.settings = {"noise.F_mean=0", "noise.F_sd=0.3N", "chirp.F_mean=0"}, .rate = rate, .seed = 3});
    press.resize(static_cast<std::size_t>(seconds * rate));
    std::vector<std::vector<double>> all;
    for (std::size_t u = 0; u < units; ++u) {
        auto f = press;
        std::rotate(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(u * 37 % f.size()), f.end());
        for (auto& x : f) x *= 0.25 + static_cast<double>(u % 17) / 8;
        all.push_back(std::move(f));
    }
    return all;
}

/// A plan whose parameters lie about their defaults.
AfferentPlan scattered(AfferentPlan plan, std::uint64_t seed, std::uint32_t unit) {
    for (std::uint32_t k = 0; k < plan.values.size(); ++k) {
        const auto& row = (*plan.parameters)[k].row;
        auto& value = plan.values[k];
        if (row.name == "t_ref") value = unit % 3 ? 0 : 1e-3 * unit;
        else if (!row.one_for_all && row.name != "V_reset" && row.name != "c")
            value = std::clamp(value * (1 + 0.1 * normal(seed, unit, k, 0)), row.low, row.high);
    }
    return plan;
}

Case own_parameters(const std::string& name, std::size_t units, const Run& run, double seconds, std::uint64_t seed) {
    Case c{{}, forces(units, 1 / run.dt, seconds), run};
    const auto plan = sure(plan_afferent(name, {}));
    for (std::uint32_t u = 0; u < units; ++u) c.plans.push_back(scattered(plan, seed, u));
    return c;
}

TEST(Population, EveryChainOnLanesGivesTheBitsOfOneByOne) {
    for (const auto& name : every_chain())
        for (const auto method : {Method::exact, Method::backward_euler})
            for (const bool sampled : {false, true}) {
                const corpuscle::Run run{5e-4, method, sampled};
                const Case shared{{sure(plan_afferent(name, {}))}, forces(70, 2e3, 0.3), run}, own = own_parameters(name, 70, run, 0.3, 8);
                const auto right = one_by_one(shared), right_own = one_by_one(own);
                if (method == Method::exact) {
                    EXPECT_FALSE(right.empty()) << name;
                }
                for (const auto set : lane_sets()) {
                    EXPECT_EQ(on_lanes(shared, {set}), right) << name << ' ' << name_of(set);
                    EXPECT_EQ(on_lanes(own, {set}), right_own) << name << ' ' << name_of(set);
                }
            }
}

}  // namespace
}  // namespace corpuscle
