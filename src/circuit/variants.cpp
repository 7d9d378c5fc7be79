#include "circuit/variants.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analysis/bench.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/netlist/number.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double most_variants = 1e6;

Error too_many(const Command& c, double count) {
    return bad_input(fmt::format(".{}: {:g} values; at most {:g}", c.name, count, most_variants), c.place);
}

Result<std::vector<double>> evenly(const Command& c, std::size_t word) {
    const auto from = number_of(c, word, "a value to begin with"), to = number_of(c, word + 1, "a value to end with"),
               step = number_of(c, word + 2, "a step");
    for (const auto* part : {&from, &to, &step})
        if (!*part) return part->error();
    const double count = std::floor((*to - *from) / *step + 1e-9);
    if (!(count >= 0)) return bad_input(fmt::format(".step: a step of {:g} does not lead from {:g} to {:g}", *step, *from, *to), c.place);
    if (!(count < most_variants)) return too_many(c, count);
    std::vector<double> out;
    for (double k = 0; k <= count; ++k) out.push_back(*from + k * *step);
    return out;
}

Result<std::vector<double>> by_powers(const Command& c, std::size_t word, double base) {
    const auto from = number_of(c, word, "a value to begin with"), to = number_of(c, word + 1, "a value to end with"),
               points = number_of(c, word + 2, "a number of points");
    for (const auto* part : {&from, &to, &points})
        if (!*part) return part->error();
    if (!(*from > 0 && *to >= *from && *points >= 1))
        return bad_input(
            fmt::format(".step: {:g} points from {:g} to {:g}; both above 0, the second not below the first", *points, *from, *to),
            c.place);
    const double count = std::floor(std::log(*to / *from) / std::log(base) * *points + 1e-9);
    if (!(count < most_variants)) return too_many(c, count);
    std::vector<double> out;
    for (double k = 0; k <= count; ++k) out.push_back(*from * std::pow(base, k / *points));
    return out;
}

}  // namespace

Result<Chips> chips_of(const Command& c) {
    Chips out;
    const auto count = number_of(c, 0, "a number of draws");
    if (!count) return count.error();
    out.count = *count;
    for (std::size_t k = 1; k < c.words.size(); ++k) {
        const auto equals = c.words[k].find('=');
        const auto name = c.words[k].substr(0, equals);
        const auto value = equals == std::string::npos ? std::nullopt : whole_number(std::string_view(c.words[k]).substr(equals + 1));
        if (!value || (name != "seed" && name != "process" && name != "mismatch"))
            return bad_input(fmt::format(".mc: '{}' must be seed=NUMBER, process=0|1 or mismatch=0|1", c.words[k]), c.place);
        if (name == "seed") {
            if (!(value->value >= 0 && value->value < 0x1p53))
                return bad_input(fmt::format(".mc: seed={:g} must be from 0 to 2^53", value->value), c.place);
            out.seed = static_cast<std::uint64_t>(value->value);
        }
        if (name == "process") out.process = value->value != 0;
        if (name == "mismatch") out.mismatch = value->value != 0;
    }
    return out;
}

Draw Chips::draw(std::uint64_t chip) const {
    Draw out{seed, first + chip, mismatch, {}};
    if (process) std::copy_n(process_deviates(seed, first + chip).of, 4, out.process);
    return out;
}

std::optional<Draw> own_draw(const Circuit& c) {
    if (!c.mismatch) return {};
    return Chips{1, *c.mismatch, true, true, c.chip}.draw(0);
}

Result<Variants> Variants::of(const Netlist& netlist) {
    Variants out{};
    out.netlist_ = netlist;
    auto plain = netlist.elaborate();
    if (!plain) return plain.error();
    out.plain_ = std::make_shared<const Circuit>(std::move(*plain));
    double count = 1;
    for (const auto& c : out.plain_->commands) {
        if (c.name == "step") {
            std::size_t at = 0;
            const auto word = [&] { return at < c.words.size() ? c.words[at] : std::string(); };
            const bool powers = word() == "dec" || word() == "oct";
            const double base = word() == "dec" ? 10 : 2;
            at += powers;
            at += word() == "param";
            Axis axis{word(), {}};
            if (axis.name.empty()) return bad_input(".step: what is stepped is missing", c.place);
            ++at;
            if (word() == "list") {
                for (++at; at < c.words.size(); ++at) {
                    const auto value = number_of(c, at, "a value");
                    if (!value) return value.error();
                    axis.values.push_back(*value);
                }
                if (axis.values.empty()) return bad_input(".step: the list is empty", c.place);
            } else {
                auto values = powers ? by_powers(c, at, base) : evenly(c, at);
                if (!values) return values.error();
                axis.values = std::move(*values);
            }
            count *= static_cast<double>(axis.values.size());
            if (count > most_variants) return too_many(c, count);
            out.axes_.push_back(std::move(axis));
        }
        if (c.name == "mc") {
            const auto chips = chips_of(c);
            if (!chips) return chips.error();
            count *= chips->count;
            if (!(chips->count >= 1 && count <= most_variants)) return too_many(c, count);
            out.chips_ = *chips;
            out.chips_.count = std::floor(chips->count);
        }
    }
    return out;
}

std::size_t Variants::count() const {
    std::size_t count = std::max<std::size_t>(static_cast<std::size_t>(chips_.count), 1);
    for (const auto& axis : axes_) count *= axis.values.size();
    return count;
}

Result<void> Variants::step(std::size_t number) {
    if (last_ && last_->number == number) return {};
    if (axes_.empty()) {
        last_ = {number, "", plain_};
        return {};
    }
    Values parameters;
    std::optional<double> temperature;
    std::string label;
    auto rest = number;
    for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
        const double value = axis->values[rest % axis->values.size()];
        rest /= axis->values.size();
        axis->name == "temp" ? void(temperature = value) : void(parameters[axis->name] = value);
        label = fmt::format("{}={:g}{}{}", axis->name, value, label.empty() ? "" : " ", label);
    }
    auto circuit = netlist_.elaborate(parameters);
    if (!circuit) return circuit.error();
    if (temperature) circuit->temperature = *temperature;
    last_ = {number, std::move(label), std::make_shared<const Circuit>(std::move(*circuit))};
    return {};
}

Result<Variant> Variants::at(std::size_t number) {
    const std::size_t draws = std::max<std::size_t>(static_cast<std::size_t>(chips_.count), 1), chip = number % draws;
    if (auto ok = step(number / draws); !ok) return ok.error();
    Variant out{last_->label, last_->circuit, {}};
    out.draw = own_draw(*out.circuit);
    if (!this->draws()) return out;
    out.draw = chips_.draw(chip);
    out.label += fmt::format("{}mc={}", out.label.empty() ? "" : " ", chip + 1);
    return out;
}

}  // namespace corpuscle::circuit
