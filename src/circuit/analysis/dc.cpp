// .dc: operating points along one or two sweeps, each found from the one before, so that hysteresis shows.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analyses.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

struct Sweep {
    std::string what;  // an element, or "temp"
    double from, to, step;
    std::vector<double> values() const {
        std::vector<double> out;
        const auto count = static_cast<long>(std::floor((to - from) / step * (1 + 1e-12) + 1e-9));
        for (long k = 0; k <= count; ++k) out.push_back(from + static_cast<double>(k) * step);
        return out;
    }
};

Result<Sweep> sweep_of(const TestBench& bench, const Command& c, std::size_t word) {
    if (word >= c.words.size()) return bad_input(".dc: what is swept is missing", c.place);
    Sweep s{c.words[word], 0, 0, 0};
    const auto from = number_of(c, word + 1, "where the sweep begins"), to = number_of(c, word + 2, "where the sweep ends"),
               step = number_of(c, word + 3, "the sweep's step");
    for (const auto* part : {&from, &to, &step})
        if (!*part) return part->error();
    s.from = *from, s.to = *to, s.step = *step;
    if (s.step == 0 || (s.to - s.from) / s.step < 0) s.step = s.to == s.from ? 1 : s.step;
    if (s.step == 0 || (s.to - s.from) / s.step < 0)
        return bad_input(fmt::format(".dc {}: a step of {:g} does not lead from {:g} to {:g}", s.what, *step, s.from, s.to), c.place);
    if ((s.to - s.from) / s.step > 1e7)
        return bad_input(fmt::format(".dc {}: {:g} points; at most 10000000", s.what, (s.to - s.from) / s.step), c.place);
    if (s.what == "temp") return s;
    const auto* device = bench.system.device(s.what);
    if (device == nullptr || !device->setting()) {
        std::vector<std::string_view> known = {"temp"};
        for (const auto& d : bench.system.devices())
            if (d->setting()) known.push_back(d->name);
        return bad_input(fmt::format(".dc: '{}' is no source, resistor or temp{}", s.what, did_you_mean(s.what, known)), c.place);
    }
    return s;
}

std::string type_of(const std::string& what) {
    return what == "temp" ? "temp-sweep" : what[0] == 'i' ? "current" : what[0] == 'v' ? "voltage" : "notype";
}
std::string name_of(const std::string& what) {
    return what == "temp" ? "temp-sweep" : what[0] == 'i' ? "i-sweep" : what[0] == 'v' ? "v-sweep" : "res-sweep";
}

/// The bench that a sweep works on: the given one, whose sources it leaves as they were; at another temperature one of its own.
class Swept {
    TestBench& given_;
    std::unique_ptr<TestBench> other_;
    struct Source {
        std::string name;
        double before, now;
    };
    std::vector<Source> sources_;

public:
    explicit Swept(TestBench& given) : given_(given) {}
    Swept(const Swept&) = delete;
    ~Swept() {
        for (const auto& s : sources_) given_.system.device(s.name)->set(s.before);
    }
    TestBench& bench() { return other_ ? *other_ : given_; }

    Result<void> set(const std::string& what, double value) { return what == "temp" ? temperature(value) : source(what, value); }

private:
    Result<void> temperature(double value) {
        auto copy = std::make_shared<Circuit>(*given_.circuit);
        copy->temperature = value;
        auto made = TestBench::make(std::move(copy));
        if (!made) return made.error();
        other_ = std::move(*made);
        if (given_.drawn()) other_->draw(*given_.drawn());
        for (const auto& s : sources_) other_->system.device(s.name)->set(s.now);
        return {};
    }
    Result<void> source(const std::string& name, double value) {
        auto at = std::find_if(sources_.begin(), sources_.end(), [&](const Source& s) { return s.name == name; });
        if (at == sources_.end()) at = sources_.insert(at, {name, given_.system.device(name)->setting().value_or(0), value});
        at->now = value;
        if (!bench().system.device(name)->set(value))
            return bad_input(fmt::format(".dc: {} cannot be {:g}", name, value), Place{given_.circuit->file});
        return {};
    }
};

}  // namespace

Result<Findings> analyse_dc(TestBench& given, const Command& c) {
    auto words = c;
    const bool both = !words.words.empty() && words.words.back() == "updown";
    if (both) words.words.pop_back();
    if (words.words.size() != 4 && words.words.size() != 8)
        return bad_input(fmt::format(".dc: {} words; it is .dc SOURCE FROM TO STEP, once or twice", words.words.size()), c.place);
    const auto inner = sweep_of(given, words, 0);
    if (!inner) return inner.error();
    std::optional<Sweep> outer;
    if (words.words.size() == 8) {
        auto second = sweep_of(given, words, 4);
        if (!second) return second.error();
        outer = *second;
    }
    auto values = inner->values();
    if (both)
        for (std::size_t k = values.size() - 1; k-- > 0;) values.push_back(values[k]);
    const auto outers = outer ? outer->values() : std::vector<double>{0};
    if (static_cast<double>(values.size()) * static_cast<double>(outers.size()) > 1e7)
        return bad_input(fmt::format(".dc: {} times {} points; at most 10000000", values.size(), outers.size()), c.place);

    Plot plot = plot_of(given.system, "DC transfer characteristic", name_of(inner->what), type_of(inner->what));
    Swept swept(given);
    for (std::size_t k = 0; k < outers.size(); ++k) {
        if (outer)
            if (auto ok = swept.set(outer->what, outers[k]); !ok) return ok.error();
        std::vector<double> x;
        for (std::size_t j = 0; j < values.size(); ++j) {
            if (given.stopped(static_cast<double>(k * values.size() + j) / static_cast<double>(outers.size() * values.size())))
                return interruption();
            if (auto ok = swept.set(inner->what, values[j]); !ok) return ok.error();
            auto& bench = swept.bench();
            const auto found = operating_point(bench.newton, x);
            if (!found) {
                auto error = found.error();
                error.sentence = fmt::format(".dc at {} = {:g}{}: {}", inner->what, values[j],
                                             outer ? fmt::format(", {} = {:g}", outer->what, outers[k]) : "", error.sentence);
                return error;
            }
            x = found->x;
            append(plot, values[j], std::span<const double>(x));
        }
    }
    Findings out;
    out.plots.push_back(std::move(plot));
    return out;
}

}  // namespace corpuscle::circuit
