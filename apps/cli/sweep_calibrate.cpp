// corpuscle sweep calibrate: chips of one netlist, each trimmed until it fires as a model does; how many bits that takes.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "circuit/variants.hpp"
#include "study/sweep/calibration_told.hpp"
#include "study/trains.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

/// What the two chips are trimmed by if nobody says.
struct UsualTrims {
    const char *netlist, *model, *trims[3];
};
constexpr UsualTrims usual[] = {
    {"sa1-circuit", "sa1", {"i_leak=100%", "i_biasb=25%", "summer.n3b.m=50%"}},
    {"fa1-circuit", "fa1", {"i_leak=100%", "i_biasb=25%", "rect.p1b.m+rect.n2b.m=50%"}},
};

/// "summer.n3b.m=50%": the knobs, joined by +, and the range. Columns (.m) are whole.
Result<Trim> trim_said(const std::string& text, const ChipCalibration& asked) {
    const auto equals = text.find('=');
    const auto range = equals == std::string::npos ? std::nullopt : std::optional(text.substr(equals + 1));
    char* end = nullptr;
    const double percent = range ? std::strtod(range->c_str(), &end) : 0;
    if (!range || end == range->c_str() || std::string(end) != "%" || !(percent > 0 && percent <= 1000))
        return bad_usage(fmt::format("--trim {}: it is NAME=RANGE, such as i_leak=50%: the highest code gives half as much again", text));
    std::vector<std::string> names;
    for (std::size_t from = 0; from < equals;) {
        const auto to = std::min(text.find('+', from), equals);
        names.push_back(text.substr(from, to - from));
        from = to + 1;
    }
    if (names.empty() || names[0].empty()) return bad_usage(fmt::format("--trim {}: the name is missing", text));
    const bool whole = names[0].ends_with(".m");
    return trim_of(asked.netlist, asked.knobs, std::move(names), percent / 100, whole);
}

/// Model, touch and limits.
constexpr double first = 10e-3;  // s, that the first spike may be off

Result<void> aim(ChipCalibration& asked, const std::string& model, const SweepCalibrateWords& words) {
    const Asked press{model, words.force, {}, 10e3};
    const auto touch = touch_of(press);
    if (!touch) return touch.error();
    const auto train = train_of(press);
    if (!train) return train.error();
    asked.force = touch->force, asked.T = touch->clock.T();
    std::vector<Stretch> phases;
    double from = 0;
    for (const auto& p : touch->phases) {
        if (p.from > from) phases.push_back({from, p.from});
        phases.push_back({p.from, p.to}), from = p.to;
    }
    const double end = static_cast<double>(asked.force.size()) * asked.T;
    if (end > from) phases.push_back({from, end});
    asked.limits = FiringLimits::about(*train, phases, first);
    return {};
}

Result<std::vector<CalibrationTold>> work(ChipCalibration& asked, const std::vector<Trim>& trims, const SweepCalibrateWords& words) {
    const circuit::Chips drawn{static_cast<double>(words.units), words.seed};
    std::vector<circuit::Draw> chips;
    for (std::int64_t k = 0; k < words.units; ++k) chips.push_back(drawn.draw(static_cast<std::uint64_t>(k)));
    std::vector<std::vector<Trim>> sets = {trims};
    if (words.apart && trims.size() > 1)
        for (const auto& t : trims) sets.push_back({t});
    std::vector<CalibrationTold> out;
    for (const auto& set : sets) {
        asked.trims = set;
        auto done = calibrate(asked, chips);
        if (!done) return done.error();
        out.push_back({set, std::move(*done)});
    }
    return out;
}

Result<void> calibrate_as(const SweepCalibrateWords& words, const Common& common) {
    const UsualTrims* known = nullptr;
    for (const auto& u : usual)
        if (words.netlist == u.netlist) known = &u;
    if (!known && (words.trims.empty() || words.like.empty()))
        return bad_usage(fmt::format("sweep calibrate {}: --like MODEL and --trim NAME=RANGE must be said of this netlist", words.netlist));
    if (words.units < 1 || words.units > 1'000'000) return bad_usage(fmt::format("--units {}: 1 to 1000000", words.units));
    ChipCalibration asked;
    asked.netlist = words.netlist, asked.bits = words.bits, asked.threads = words.threads;
    asked.knobs = {{"corner", words.corner, "--corner " + words.corner}};
    asked.batch.most_iterations = 60'000;
    asked.batch.stop = interrupted;
    if (auto ok = aim(asked, words.like.empty() ? known->model : words.like, words); !ok) return ok;
    std::vector<Trim> trims;
    for (const auto& text :
         words.trims.empty() ? std::vector<std::string>(std::begin(known->trims), std::end(known->trims)) : words.trims) {
        auto trim = trim_said(text, asked);
        if (!trim) return trim.error();
        trims.push_back(std::move(*trim));
    }
    auto done = [&] {
        Progress progress(common.quiet);
        asked.told = [&](std::size_t left, std::size_t) { progress.at(1 - static_cast<double>(left) / static_cast<double>(words.units)); };
        return work(asked, trims, words);
    }();
    if (!done) return done.error();
    if (common.json)
        fmt::print("{}\n", document_of(asked, *done).dump(1));
    else
        show(text_of(asked, *done));
    return {};
}

}  // namespace

int sweep_calibrate(const SweepCalibrateWords& words, const Common& common) {
    catch_interrupt();
    const auto done = calibrate_as(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
