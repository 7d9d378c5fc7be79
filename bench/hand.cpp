// How much faster than real time does a complete hand respond, and how much memory does it use?
//
//     bench-hand [SECONDS] [RUNS] [POPULATION]      default: 10 s of touch, 7 runs, hand
//
// Method: the built-in hand (17,144 afferents, 4,793 sites), one thread, spikes stored as binary address events, processor time of this
// process. Construction and runs are timed separately. Output: median, minimum and maximum of the runs, then the work: steps of afferents
// computed, steps skipped because no force acted and no state could change, spikes, bytes written. There are three forces, all at 1 kHz:
// - `stroke` moves a fingertip over the hand with 1 N for 10 s, as in `corpuscle respond stroke --population hand`;
// - a flat disk of 80 mm diameter presses the palm with a sine for SECONDS;
// - noise on every site for SECONDS keeps every afferent active, which is the worst case.
// Peak memory is that of the complete process.
//
// Compared with TouchSim: peers/touchsim_hand.py; doc/skin.md lists the work that TouchSim does and this program does not.

#include <fmt/format.h>
#include <sys/resource.h>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>

#include "core/random.hpp"
#include "core/stimulus/stimuli.hpp"
#include "run/sinks.hpp"
#include "run/skin/skin_simulator.hpp"

namespace {

using namespace corpuscle;

/// Processor time of this process, s.
double processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class T>
T value_or_exit(Result<T> result) {
    if (result) return std::move(*result);
    fmt::print(stderr, "{}\n", result.error().text());
    std::exit(1);
}

/// Noise that differs between sites: 64 samples for each site, repeated.
class NoiseForce final : public SkinForce {
    static constexpr std::size_t block = 64;                               // samples
    std::vector<double> force_, total_ = std::vector<double>(block, 1.0);  // N: at each site; in total, which is not the sum here
    std::int64_t left_, all_;                                              // samples

public:
    NoiseForce(std::size_t sites, std::int64_t samples) : force_(sites * block), left_(samples), all_(samples) {
        for (std::size_t k = 0; k < force_.size(); ++k) force_[k] = 0.02 + 0.005 * normal(1, 0, 0, k);
    }
    Result<Block> next() override {
        const auto steps = static_cast<std::size_t>(std::min<std::int64_t>(block, left_));
        left_ -= static_cast<std::int64_t>(steps);
        return Block{{force_.data(), block}, {total_.data(), steps}};
    }
    double progress() const override { return 1 - static_cast<double>(left_) / static_cast<double>(all_); }
};

/// One of the forces. `source` and `contact` are null for noise.
struct PressCase {
    std::unique_ptr<ForceSource> source;
    std::unique_ptr<Contact> contact;
    std::unique_ptr<SkinForce> force;
};

/// A stimulus at 1 kHz that acts through an indenter.
PressCase press(const Innervation& skin, std::string_view stimulus, std::string_view indenter, std::vector<ParameterOverride> overrides) {
    PressCase p{value_or_exit(make_stimulus(stimulus, overrides, 1e3, 0)).result, {}, {}};
    p.contact = value_or_exit(make_contact(indenter, overrides, skin.plan.sites, p.source->clock())).result;
    p.force = make_pressed_force(*p.source, *p.contact);
    return p;
}

/// `seconds`: processor time of each run; `simulated`: s of touch in a run, or 0 if none are simulated.
void print_times(const char* label, std::vector<double> seconds, double simulated) {
    std::sort(seconds.begin(), seconds.end());
    const double median = seconds[seconds.size() / 2];
    fmt::print("  {:<34} {:6.1f} ms ({:.1f} to {:.1f})", label, 1e3 * median, 1e3 * seconds.front(), 1e3 * seconds.back());
    if (simulated > 0) fmt::print("  {:5.0f} times real time", simulated / median);
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    const double length = argc > 1 ? std::atof(argv[1]) : 10;
    const int runs = argc > 2 ? std::atoi(argv[2]) : 7;
    const std::string name_of_skin = argc > 3 ? argv[3] : "hand";
    const auto folder = (std::filesystem::temp_directory_path() / fmt::format("bench-hand-{}", ::getpid())).string();
    const auto file = folder + "/spikes.aer";
    const auto set = value_or_exit(instruction_set());
    std::vector<double> build_times;
    std::shared_ptr<const Innervation> skin;
    for (int k = 0; k < runs; ++k) {
        const double from = processor();
        skin = value_or_exit(innervate(value_or_exit(load_skin_plan(name_of_skin))));
        (void)value_or_exit(Skin::make(skin, {1e-3}, set));
        build_times.push_back(processor() - from);
    }
    fmt::print("{}: {} afferents, {} sites, {}\n", skin->plan.name, skin->afferents.size(), skin->plan.sites.size(), name_of(set));
    print_times("built from its file", build_times, 0);

    const NamedTouch& stroke = named_touches()[0];
    std::vector<ParameterOverride> stroked, palm = {{"sine", "duration", fmt::format("{}", length)},
                                                    {"sine", "f", "2"},
                                                    {"sine", "F_mean", "20"},
                                                    {"sine", "F_amp", "10"},
                                                    {"contact", "radius", "0.04"},
                                                    {"contact", "x", "0"},
                                                    {"contact", "y", "0.06"}};
    for (const auto& s : stroke.settings) stroked.push_back({"contact", std::string(s.name), fmt::format("{}", s.value)});
    for (const auto& s : stroke.force_settings)
        stroked.push_back({std::string(stroke.force), std::string(s.name), fmt::format("{}", s.value)});
    const std::pair<const char*, std::function<PressCase()>> forces[] = {
        {"stroke", [&] { return press(*skin, stroke.force, stroke.indenter, stroked); }},
        {"sine on the palm", [&] { return press(*skin, "sine", "flat", palm); }},
        {"noise everywhere", [&] {
             PressCase p;
             p.force = std::make_unique<NoiseForce>(skin->plan.sites.size(), static_cast<std::int64_t>(1e3 * length));
             return p;
         }}};
    for (const auto& [name, make] : forces) {
        std::vector<double> run_times;
        RunStats work;
        std::uintmax_t bytes = 0;
        for (int k = 0; k < runs; ++k) {
            auto force = make();
            auto skin_state = value_or_exit(Skin::make(skin, {1e-3}, set));
            const auto out = value_or_exit(events_format.make({.directory = folder, .options = {{"--events", "aer"}}}));
            Sink* const sinks[] = {out.get()};
            SkinPopulation population(*skin);
            const Input input{{name, "", *make_clock(1e3)}, population};
            std::vector<std::unique_ptr<BlockSimulator>> inputs;
            inputs.push_back(std::make_unique<SkinSimulator>(population, input, *force.force, *skin_state));
            const double from = processor();
            work = value_or_exit(run(std::move(inputs), sinks, {}));
            if (!out->commit()) return 1;
            run_times.push_back(processor() - from);
            bytes = std::filesystem::file_size(file);
            std::filesystem::remove(file);
        }
        print_times(name, run_times, static_cast<double>(work.samples) * 1e-3);
        fmt::print("  {:<34} {:.3g} afferent-steps computed, {:.3g} skipped; {} spikes, {} bytes\n", "",
                   static_cast<double>(work.afferent_steps), static_cast<double>(work.skipped_steps), work.spikes, bytes);
    }
    std::filesystem::remove(folder);
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    fmt::print("peak memory: {} MB\n", used.ru_maxrss / 1000);
}
