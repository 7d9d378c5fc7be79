// How many afferent-steps per second does a population of `sa1` compute on one core, and how close is this to the machine's limit?
//
// Method: one process runs these cases in turn, 25 times (--runs): reading the streamed force and summing it (the memory limit), additions
// in registers (the arithmetic limit), and the population with each kind of input. Output: medians of wall time. There are N = 100,000
// afferents at 10 kHz. Spikes are stored in memory in order, or as marks (one bit per afferent and step). The names of the cases mean:
// - streamed: each afferent has its own force, in tiles; 1,000 steps from the press's rise, 800 MB in double, which exceeds the caches;
// - profile: one press of 10,000 steps; each afferent has a gain from 0.5 to 1, and the receptor is computed once;
// - own parameters: every afferent has its own f_B and its own receptor;
// - interpolated: spikes have times between the samples; in all other cases they are on the samples;
// - the peers': the tasks of peers/work.py, in backward Euler, for comparison with NumPy and Brian2.
// --only WORDS: only the two limits and the cases whose name contains WORDS.
//
// Arithmetic operations for `sa1`, method exact, per afferent-step without a spike. Receptor 12: 1 difference of forces, 2 high-passes of
// 3, 2 rectifiers, 3 for the sum. Neuron LIF-B 8: 2 for the input current, 1 addition, 1 limit at E_L, 1 comparison with the threshold, 3
// to test whether the current rises past the leak. Together 20 operations and 8, 4 or 2 bytes (double, float, 16-bit integers). A step of a
// profile in which the current does not rise needs 5 operations and no bytes. The printed limit is the lower of the memory limit and the
// arithmetic limit; an operation in float counts half of one in double.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>

#include "core/stimulus/stimuli.hpp"
#include "model/catalog.hpp"
#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"

namespace {

using namespace corpuscle;

constexpr std::size_t max_count = 100'000;  // afferents
constexpr std::size_t stream_steps = 1000;
constexpr std::size_t rise_step = 2400;  // of the press: its rise begins at step 2500
constexpr long rounds = 20'000'000;      // of 64 additions
volatile double discarded;               // keeps the compiler from leaving out a computation

/// Wall time, s.
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

[[noreturn]] void stop(const std::string& why) {
    fmt::print(stderr, "bench-population: {}\n", why);
    std::exit(1);
}

// The compiler vectorizes the code that measures the two limits, for each instruction set. It does not use the lanes, which are the code
// under test.
#ifdef CORPUSCLE_AVX
#define EACH_SET __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), optimize("O3,unroll-loops")))
#else
#define EACH_SET
#endif

typedef double Vector __attribute__((vector_size(64)));

/// The sum of `count` numbers; `count` must be a multiple of 32.
EACH_SET double sum(const double* p, std::size_t count) {
    Vector s[4] = {};
    const auto* v = reinterpret_cast<const Vector*>(p);
    for (std::size_t k = 0; k + 4 <= count / 8; k += 4)
        for (std::size_t j = 0; j < 4; ++j) s[j] += v[k + j];
    const Vector all = s[0] + s[1] + s[2] + s[3];
    return all[0] + all[1] + all[2] + all[3] + all[4] + all[5] + all[6] + all[7];
}

/// Performs `count` rounds of 64 additions of doubles in registers. Eight independent chains hide the latency.
template <class V>
[[gnu::always_inline]] inline double additions(long count) {
    V a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{};
    for (long k = 0; k < count * 8 * static_cast<long>(sizeof(double)) / static_cast<long>(sizeof(V)); ++k) {
        a += 1e-9, b += 1e-9, c += 1e-9, d += 1e-9, e += 1e-9, f += 1e-9, g += 1e-9, h += 1e-9;
        // Without this, the compiler would combine the additions.
        asm volatile("" : "+x"(a), "+x"(b), "+x"(c), "+x"(d), "+x"(e), "+x"(f), "+x"(g), "+x"(h));
    }
    return (a + b + c + d + e + f + g + h)[0];
}
typedef double Two __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));
#ifdef CORPUSCLE_AVX
[[gnu::target("arch=x86-64-v4")]] double additions_avx512(long count) { return additions<Vector>(count); }
[[gnu::target("arch=x86-64-v3")]] double additions_avx2(long count) { return additions<Four>(count); }
#endif
double additions(long count) {
#ifdef CORPUSCLE_AVX
    if (instruction_sets().back() == InstructionSet::avx512) return additions_avx512(count);
    if (instruction_sets().back() == InstructionSet::avx2) return additions_avx2(count);
#endif
    return additions<Two>(count);
}

/// The samples of the press at 10 kHz, N.
std::vector<double> press() {
    Frames block(1, 10000);
    const auto source = make_stimulus("press", 10e3, 0);
    if (!source || !(*source)->read(block)) stop("cannot create the press stimulus");
    return block.force[0];
}

/// Factor of the force of this afferent: 0.5 for the first, 1 for the last.
double gain(std::size_t afferent_index) { return 0.5 + 0.5 * static_cast<double>(afferent_index) / (max_count - 1); }

/// The rise of the press multiplied by each afferent's gain and by `scale`, in tiles: [tile][step][afferent in the tile].
template <class E>
lanes::AlignedBuffer<E> tiles(const std::vector<double>& f, double scale) {
    const std::size_t count = (max_count + tile_width - 1) / tile_width;
    lanes::AlignedBuffer<E> rows(count * tile_width * stream_steps);
    E* out = rows.data();
    for (std::size_t tile = 0; tile < count; ++tile)
        for (std::size_t t = 0; t < stream_steps; ++t)
            for (std::size_t u = 0; u < tile_width; ++u) *out++ = static_cast<E>(f[rise_step + t] * gain(tile * tile_width + u) * scale);
    return rows;
}

/// A computation that is timed, and its times.
struct TimedCase {
    std::string name;
    double work;                       // bytes, additions or afferent-steps in a run
    std::function<double()> run_once;  // returns its wall time, s
    double operations = 0, bytes = 0;  // of a population, per afferent-step: operations in double, bytes of force
    std::vector<double> seconds = {};  // of each run
    std::int64_t spikes = 0;           // of the last run

    /// Median work per second.
    double rate() const {
        auto s = seconds;
        std::nth_element(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2), s.end());
        return work / s[s.size() / 2];
    }
};

/// A population and its complete force, in blocks.
struct Case {
    std::size_t afferents = max_count;
    std::size_t steps = 0, block = 0;  // in total; in a block
    Method method = Method::exact;
    bool own_parameters = false;  // each afferent has its own f_B
    bool sampled = true;          // spikes are on the samples; otherwise their times are interpolated
    bool marks = false;           // spikes are stored as bits
    Precision precision = Precision::double_precision;
    InstructionSet set = InstructionSet::baseline;
    std::function<PopulationForce(std::size_t first, std::size_t steps)> force = {};  // of `steps` steps from step `first`

    std::unique_ptr<LanePopulation> make_population() const {
        const auto plan = plan_afferent("sa1");
        std::vector<AfferentPlan> plans(own_parameters ? afferents : 1, *plan);
        for (std::size_t u = 0; own_parameters && u < afferents; ++u)
            for (std::size_t k = 0; k < plans[u].values.size(); ++k)
                if ((*plans[u].parameters)[k].info.name == "f_B") plans[u].values[k] = 15 + 10 * static_cast<double>(u) / (max_count - 1);
        std::vector<const AfferentPlan*> pointers;
        for (const auto& p : plans) pointers.push_back(&p);
        auto result = make_lane_population({pointers, afferents, {}, precision}, {1e-4, method, sampled}, set);
        if (!result) stop(result.error().text());
        return std::move(*result);
    }

    /// Simulates the population; returns its wall time, s, without making the population and the force. Also counts the spikes.
    double run_once(std::int64_t& spikes) const {
        static ThreadPool single_thread(1);
        static std::vector<Spike> found;
        static std::vector<std::uint64_t> bits;
        const auto population = make_population();
        double elapsed = 0;
        spikes = 0;
        for (std::size_t k = 0; k < steps; k += block) {
            const std::size_t count = std::min(block, steps - k);
            found.clear();
            PopulationResponse response{marks ? nullptr : &found, marks ? &bits : nullptr};
            const auto f = force(k, count);
            const double start = now();
            const auto done = population->respond(f, count, response, single_thread);
            elapsed += now() - start;
            if (!done) stop(done.error().text());
            for (std::size_t w = 0; marks && w < bits.size(); ++w) spikes += __builtin_popcountll(bits[w]);
            spikes += static_cast<std::int64_t>(found.size());
        }
        return elapsed;
    }
};

/// All cases, with their forces.
class Bench {
    std::string only_;
    std::vector<double> press_ = press(), gains_;
    lanes::AlignedBuffer<double> doubles_ = tiles<double>(press_, 1);
    lanes::AlignedBuffer<float> floats_ = tiles<float>(press_, 1);
    lanes::AlignedBuffer<std::int16_t> words_ = tiles<std::int16_t>(press_, 8000);  // 1/8000 N
    std::vector<std::unique_ptr<TimedCase>> all_;

    /// operations, bytes: see TimedCase.
    void add(const std::string& name, const Case& c, double operations, double bytes) {
        if (name.find(only_) == std::string::npos) return;
        all_.push_back(std::make_unique<TimedCase>(TimedCase{name, static_cast<double>(c.afferents * c.steps), {}, operations, bytes}));
        all_.back()->run_once = [c, t = all_.back().get()] { return c.run_once(t->spikes); };
    }

    PopulationForce streamed(Precision precision) const {
        if (precision == Precision::double_precision) return ForceTiles<double>{doubles_.data()};
        return ForceTiles<float>{floats_.data()};
    }

    Case profile_case(InstructionSet set, Precision precision) const {
        Case c{.steps = 10000, .block = 1000, .precision = precision, .set = set};
        c.force = [this](std::size_t k, std::size_t n) { return PopulationForce(ForceProfile{std::span(press_).subspan(k, n), gains_}); };
        return c;
    }

    /// Adds the cases of one instruction set and precision.
    void add_set(InstructionSet set, Precision precision) {
        const bool in_double = precision == Precision::double_precision;
        const std::string tag = fmt::format("{} {} ", name_of(set), in_double ? "double" : "float");
        const double operation = in_double ? 1 : 0.5, bytes = in_double ? 8 : 4;  // in additions of doubles; of one force
        const auto changed = [](Case c, auto change) { return change(c), c; };
        Case stream{.steps = stream_steps, .block = stream_steps, .precision = precision, .set = set};
        stream.force = [this, precision](std::size_t, std::size_t) { return streamed(precision); };
        add(tag + "streamed", stream, 20 * operation, bytes);
        add(tag + "streamed, interpolated", changed(stream, [](Case& c) { c.sampled = false; }), 20 * operation, bytes);
        if (set != instruction_sets().back()) {  // for smaller instruction sets, only the main cases
            add(tag + "profile", profile_case(set, precision), 5 * operation, 0);
            return;
        }
        add(tag + "streamed, own parameters", changed(stream, [](Case& c) { c.own_parameters = true; }), 20 * operation, bytes);
        add(tag + "streamed, 16-bit words",
            changed(stream,
                    [&](Case& c) {
                        c.force = [this](std::size_t, std::size_t) { return PopulationForce(ForceInt16{words_.data(), 1.0 / 8000}); };
                    }),
            20 * operation, 2);
        add(tag + "streamed from the cache, N = 1000", changed(stream, [](Case& c) { c.afferents = 1000, c.steps = 10000, c.block = 100; }),
            20 * operation, 0);
        const Case profile = profile_case(set, precision);
        add(tag + "profile", profile, 5 * operation, 0);
        add(tag + "profile, marks", changed(profile, [](Case& c) { c.marks = true; }), 5 * operation, 0);
        add(tag + "profile, interpolated", changed(profile, [](Case& c) { c.sampled = false; }), 5 * operation, 0);
        add(tag + "profile, own parameters",
            changed(profile,
                    [this](Case& c) {
                        c.own_parameters = true, c.steps = 1000;
                        c.force = [this](std::size_t k, std::size_t n) {
                            return PopulationForce(ForceProfile{std::span(press_).subspan(rise_step + k, n), gains_});
                        };
                    }),
            21 * operation, 0);
        const auto in_backward_euler = [](Case c) { return c.method = Method::backward_euler, c; };
        add(tag + "the peers' shared", in_backward_euler(profile), 5 * operation, 0);
        add(tag + "the peers' own",
            changed(in_backward_euler(profile),
                    [this](Case& c) {
                        c.own_parameters = true, c.steps = 2000;
                        c.force = [this](std::size_t k, std::size_t n) {
                            return PopulationForce(ForceProfile{std::span(press_).subspan(rise_step + k, n), gains_});
                        };
                    }),
            21 * operation, 0);
        add(tag + "the peers' streamed", in_backward_euler(stream), 20 * operation, bytes);
        add(tag + "profile, N = 1000",
            changed(profile,
                    [this](Case& c) {
                        c.afferents = 1000;
                        c.force = [this](std::size_t k, std::size_t n) {
                            return PopulationForce(ForceProfile{std::span(press_).subspan(k, n), std::span(gains_).first(1000)});
                        };
                    }),
            5 * operation, 0);
    }

public:
    explicit Bench(std::string only) : only_(std::move(only)) {
        for (std::size_t u = 0; u < max_count; ++u) gains_.push_back(gain(u));
        all_.push_back(std::make_unique<TimedCase>(TimedCase{"read", static_cast<double>(doubles_.size() * sizeof(double)), [this] {
                                                                 const double start = now();
                                                                 discarded = sum(doubles_.data(), doubles_.size());
                                                                 return now() - start;
                                                             }}));
        all_.push_back(std::make_unique<TimedCase>(TimedCase{"additions", 64.0 * rounds, [] {
                                                                 const double start = now();
                                                                 discarded = additions(rounds);
                                                                 return now() - start;
                                                             }}));
        const auto sets = instruction_sets();
        for (std::size_t k = sets.size() - 1; k > 0; --k)  // without the scalar set
            for (const auto precision : {Precision::double_precision, Precision::single_precision}) add_set(sets[k], precision);
    }

    void run(int runs) {
        for (auto& t : all_) (void)t->run_once();  // warm-up of pages and caches
        for (int k = 0; k < runs; ++k)
            for (auto& t : all_) t->seconds.push_back(t->run_once());
    }

    void print() const {
        const double read = all_[0]->rate(), additions = all_[1]->rate();  // the limits: bytes and additions per second
        fmt::print("read {:.1f} GB/s; {:.1f}e9 additions/s in double, with the best set\n", read / 1e9, additions / 1e9);
        fmt::print("{:50} {:>10} {:>10} {:>10} {:>9}\n", "", "steps/s", "limit", "fraction", "spikes");
        for (std::size_t k = 2; k < all_.size(); ++k) {
            const auto& t = *all_[k];
            const double limit = std::min(t.bytes > 0 ? read / t.bytes : 1e99, additions / t.operations);
            fmt::print("{:50} {:10.3e} {:10.3e} {:9.0f}% {:9}\n", t.name, t.rate(), limit, 100 * t.rate() / limit, t.spikes);
            if (t.bytes == 8 || t.bytes == 4)
                fmt::print("{:50} of memory's {:.3e}: {:.0f}%\n", "", read / t.bytes, 100 * t.rate() * t.bytes / read);
        }
    }
};

}  // namespace

int main(int argc, char** argv) {
    int runs = 25;
    std::string only;
    for (int k = 1; k + 1 < argc; k += 2) {
        if (std::string(argv[k]) == "--runs") runs = std::max(1, std::atoi(argv[k + 1]));
        if (std::string(argv[k]) == "--only") only = argv[k + 1];
    }
    Bench bench(only);
    bench.run(runs);
    bench.print();
}
