// How many afferent-steps a second does a population of `sa1` do on one core, and how far is that from what the machine could?
//
// Method: in one process, interleaved: reading the same streamed force and adding it up (the most that memory allows), multiplying
// and adding in registers (the most that arithmetic allows), and the population in each way of feeding it. Each is run 25 times
// (--runs); the median is told. Spikes go to memory, sorted, unless `marks` is said. N = 100,000 at 10 kHz. Streamed: each
// afferent has its own force, tiled, more of it than the caches hold, read once a run. Profile: one press, each afferent with a
// gain from 0.5 to 1. `own`: every afferent has its own f_B. Counted by hand for `sa1`, exact, of each afferent-step: see below.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "model/lanes/buffer.hpp"
#include "model/population.hpp"
#include "signal/stimuli.hpp"

namespace {

using namespace corpuscle;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::vector<double> press() {
    Frames block(1, 10000);
    const auto source = make_stimulus("press", {}, 10e3, 0);
    if (!(*source)->read(block)) std::exit(1);
    return block.force[0];
}

AfferentPlan sa1() { return *plan_afferent("sa1", {}); }

/// One thing that is timed: runs it once, returns the seconds it took.
struct Timed {
    std::string name;
    double work;  // afferent-steps (or bytes, operations) a run
    std::string unit;
    std::function<double()> once;
    std::vector<double> seconds = {};
    std::int64_t spikes = 0;  // a run
    double rate() const {
        auto s = seconds;
        std::nth_element(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2), s.end());
        return work / s[s.size() / 2];
    }
};

constexpr std::size_t most = 100'000;

volatile double added_up;
constexpr long most_rounds = 20'000'000;

// Compiled for each instruction set; the best that the machine has is taken. (Not by lanes: they are what is measured.)
__attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), optimize("O3,unroll-loops"))) double sum(const double* p,
                                                                                                                      std::size_t count) {
    typedef double Vector __attribute__((vector_size(64)));
    Vector s[4] = {};
    const auto* v = reinterpret_cast<const Vector*>(p);
    for (std::size_t k = 0; k + 4 <= count / 8; k += 4)
        for (std::size_t j = 0; j < 4; ++j) s[j] += v[k + j];
    const Vector all = s[0] + s[1] + s[2] + s[3];
    return all[0] + all[1] + all[2] + all[3] + all[4] + all[5] + all[6] + all[7];
}
__attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), optimize("O3"))) double adding(long rounds) {
    typedef double Vector __attribute__((vector_size(64)));
    Vector a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{};
    for (long k = 0; k < rounds; ++k) {  // eight chains of additions: 64 operations a round
        a += 1e-9, b += 1e-9, c += 1e-9, d += 1e-9, e += 1e-9, f += 1e-9, g += 1e-9, h += 1e-9;
        asm volatile("" : "+m"(k));
    }
    const Vector all = a + b + c + d + e + f + g + h;
    return all[0] + all[1] + all[2] + all[3] + all[4] + all[5] + all[6] + all[7];
}

template <class V>
struct Streams {
    lanes::Buffer<V> rows;
    std::size_t steps;
    Streams(std::size_t units, std::size_t steps_) : rows((units + 63) / 64 * 64 * steps_), steps(steps_) {
        const auto f = press();
        const std::size_t tiles = (units + 63) / 64;
        for (std::size_t tile = 0; tile < tiles; ++tile)
            for (std::size_t t = 0; t < steps; ++t)
                for (std::size_t u = 0; u < 64; ++u)
                    rows.data()[(tile * steps + t) * 64 + u] =
                        static_cast<V>(f[2400 + t] * (0.5 + 0.5 * static_cast<double>(tile * 64 + u) / static_cast<double>(most)));
    }
};

struct Made {
    std::unique_ptr<Population> population;
    std::vector<AfferentPlan> plans;
};

std::unique_ptr<Population> made(std::size_t units, bool own, Precision precision, bool sampled, Method method, InstructionSet set) {
    std::vector<AfferentPlan> plans(own ? units : 1, sa1());
    if (own)
        for (std::size_t u = 0; u < units; ++u)
            for (std::size_t k = 0; k < plans[u].values.size(); ++k)
                if ((*plans[u].parameters)[k].row.name == "f_B")
                    plans[u].values[k] = 15 + 10 * static_cast<double>(u) / static_cast<double>(units);
    std::vector<const AfferentPlan*> pointers;
    for (const auto& p : plans) pointers.push_back(&p);
    auto result = make_population({pointers, units, {}, precision}, {1e-4, method, sampled}, set);
    if (!result) std::exit(1);
    return std::move(*result);
}

/// One population over all of its force, in blocks of 250 steps.
struct Run1 {
    std::size_t units, steps;
    bool own = false;
    Precision precision = Precision::in_double;
    bool sampled = true, marks = false;
    Method method = Method::exact;
    InstructionSet set = InstructionSet::baseline;
    std::function<PopulationForce(std::size_t, std::size_t)> force;  // of a block: first step, steps
    std::size_t block = 250;
    std::size_t first = 0;

    double once(std::int64_t& spikes) const {
        const auto p = made(units, own, precision, sampled, method, set);
        static Pool alone(1);
        static std::vector<Spike> found;
        static std::vector<std::uint64_t> bits;
        spikes = 0;
        double taken = 0;
        for (std::size_t k = 0; k < steps; k += block) {
            found.clear();
            PopulationAnswer answer{marks ? nullptr : &found, marks ? &bits : nullptr};
            const auto f = force(k, std::min(block, steps - k));
            const double t0 = now();
            if (!p->respond(f, std::min(block, steps - k), answer, alone)) std::exit(1);
            taken += now() - t0;
            if (marks)
                for (const auto b : bits) spikes += __builtin_popcountll(b);
            spikes += static_cast<std::int64_t>(found.size());
        }
        return taken;
    }
};

}  // namespace

int main(int argc, char** argv) {
    int runs = 25;
    for (int k = 1; k + 1 < argc; ++k)
        if (std::string(argv[k]) == "--runs") runs = std::atoi(argv[k + 1]);
    std::string only;
    for (int k = 1; k + 1 < argc; ++k)
        if (std::string(argv[k]) == "--only") only = argv[k + 1];
    const auto sets = instruction_sets();
    std::vector<Timed> all;
    const std::size_t stream_steps = 1000;
    const Streams<double> doubles(most, stream_steps);
    const Streams<float> floats(most, stream_steps);
    lanes::Buffer<std::int16_t> words(floats.rows.size());
    for (std::size_t k = 0; k < words.size(); ++k) words.data()[k] = static_cast<std::int16_t>(floats.rows.data()[k] * 8000);
    const auto f = press();
    std::vector<double> gains;
    for (std::size_t u = 0; u < most; ++u) gains.push_back(0.5 + 0.5 * static_cast<double>(u) / (most - 1));

    const auto add = [&](const std::string& name, Run1 run) {
        if (name.find(only) == std::string::npos) return;
        const double work = static_cast<double>(run.units * run.steps);
        all.push_back({name, work, "afferent-steps/s", {}});
        const auto n = all.size() - 1;
        all.back().once = [&all, n, run] { return run.once(all[n].spikes); };
    };
    all.reserve(200);
    // The most that memory allows: the streamed force added up, four sums of 64 bytes at a time.
    all.push_back({"read", static_cast<double>(doubles.rows.size() * 8), "B/s", [&] {
                       const double t0 = now();
                       added_up = sum(doubles.rows.data(), doubles.rows.size());
                       return now() - t0;
                   }});
    // The most that arithmetic allows: sums in registers.
    all.push_back({"arithmetic", 64.0 * most_rounds, "double operations/s", [] {
                       const double t0 = now();
                       added_up = adding(most_rounds);
                       return now() - t0;
                   }});
    for (const auto set : sets.subspan(1)) {
        for (const auto precision : {Precision::in_double, Precision::in_float}) {
            const std::string tag = fmt::format("{} {}", name_of(set), precision == Precision::in_double ? "double" : "float");
            const auto tiles = [&, precision](std::size_t, std::size_t) {
                return precision == Precision::in_double ? PopulationForce(ForceTiles<double>{doubles.rows.data()})
                                                         : PopulationForce(ForceTiles<float>{floats.rows.data()});
            };
            const auto profile = [&](std::size_t k, std::size_t n) {
                return PopulationForce(ForceProfile{std::span(f).subspan(k, n), gains});
            };
            const Run1 streamed{most, stream_steps, false, precision, true, false, Method::exact, set, tiles, stream_steps};
            add(tag + " streamed sampled", streamed);
            auto v = streamed;
            v.sampled = false;
            add(tag + " streamed interpolated", v);
            v = streamed;
            v.own = true;
            add(tag + " streamed own parameters", v);
            v = streamed;
            v.force = [&](std::size_t, std::size_t) { return PopulationForce(ForceWords{words.data(), 1.0 / 8000}); };
            add(tag + " int16 sampled", v);
            const Run1 shape{most, 10000, false, precision, true, false, Method::exact, set, profile, 1000};
            add(tag + " profile sampled", shape);
            v = shape;
            v.marks = true;
            add(tag + " profile sampled marks", v);
            v = shape;
            v.sampled = false;
            add(tag + " profile interpolated", v);
            v = shape;
            v.own = true;
            v.steps = 1000;
            add(tag + " profile own parameters", v);
            const auto few = [&, precision](std::size_t, std::size_t) {
                return precision == Precision::in_double ? PopulationForce(ForceTiles<double>{doubles.rows.data()})
                                                         : PopulationForce(ForceTiles<float>{floats.rows.data()});
            };
            v = streamed;
            v.units = 1000;
            v.block = 100;
            v.steps = 10000;
            v.force = few;
            add(tag + " N=1000 streamed from the cache", v);
            v = shape;
            v.units = 1000;
            v.force = [&](std::size_t k, std::size_t n) {
                return PopulationForce(ForceProfile{std::span(f).subspan(k, n), std::span(gains).first(1000)});
            };
            add(tag + " N=1000 profile sampled", v);
        }
    }
    for (auto& t : all) (void)t.once();  // warm
    for (int k = 0; k < runs; ++k)
        for (auto& t : all) t.seconds.push_back(t.once());
    for (const auto& t : all) fmt::print("{:44} {:10.3e} {:18} {:10} spikes\n", t.name, t.rate(), t.unit, t.spikes);
}
