#include "circuit/variant/netlist_variants.hpp"

#include <algorithm>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/expression/spice_number.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_variants = 1e6;

Error too_many(const Directive& c, double count) {
    return error_at(c.location, ".{}: {:g} variants exceed the limit of {:g}", c.name, count, max_variants);
}

Result<std::vector<double>> linear_values(const Directive& c, std::size_t word) {
    const double from = TRY(read_number(c, word, "the first value")), to = TRY(read_number(c, word + 1, "the last value"));
    const double step = TRY(read_number(c, word + 2, "a step"));
    const double steps = std::floor((to - from) / step + 1e-9);
    if (!(steps >= 0)) return error_at(c.location, ".step: a step of {:g} does not lead from {:g} to {:g}", step, from, to);
    if (!(steps < max_variants)) return too_many(c, steps + 1);
    std::vector<double> out;
    for (double k = 0; k <= steps; ++k) out.push_back(from + k * step);
    return out;
}

/// The values of .step dec (base 10) or oct (base 2).
Result<std::vector<double>> log_values(const Directive& c, std::size_t word, double base) {
    const double from = TRY(read_number(c, word, "the first value")), to = TRY(read_number(c, word + 1, "the last value"));
    const double points = TRY(read_number(c, word + 2, "the number of points"));
    if (!(from > 0 && to >= from && points >= 1))
        return error_at(c.location, ".step: {:g} points from {:g} to {:g}; POINTS must be at least 1, FROM above 0, and TO not below FROM",
                        points, from, to);
    const double steps = std::floor(std::log(to / from) / std::log(base) * points + 1e-9);
    if (!(steps < max_variants)) return too_many(c, steps + 1);
    std::vector<double> out;
    for (double k = 0; k <= steps; ++k) out.push_back(from * std::pow(base, k / points));
    return out;
}

/// Reads .step [dec|oct] [param] NAME, then the values.
Result<NetlistVariants::Axis> read_axis(const Directive& c) {
    std::size_t at = 0;  // index of the word to read next
    const auto word = [&] { return at < c.words.size() ? c.words[at] : std::string(); };
    const double base = word() == "dec" ? 10 : word() == "oct" ? 2 : 0;  // 0: linear
    at += base > 0 || word() == "lin";
    at += word() == "param";
    NetlistVariants::Axis axis{word(), {}};
    if (axis.name.empty()) return error_at(c.location, ".step: the name of the parameter is missing");
    ++at;
    if (word().find('(') != std::string::npos || (axis.name.find('(') != std::string::npos))
        return error_at(c.location_of(at),
                        ".step: a parameter of a model is not stepped directly; write {{x}} for it in the .model line, and "
                        ".step param x");
    if (word() != "list") {
        axis.values = TRY(base > 0 ? log_values(c, at, base) : linear_values(c, at));
        return axis;
    }
    for (++at; at < c.words.size(); ++at) axis.values.push_back(TRY(read_number(c, at, "a value")));
    if (axis.values.empty()) return error_at(c.location, ".step: the list is empty");
    return axis;
}

}  // namespace

Result<ChipSpec> parse_chip_spec(const Directive& c) {
    ChipSpec out;
    out.count = TRY(read_number(c, 0, "the number of chips"));
    for (std::size_t k = 1; k < c.words.size(); ++k) {
        const auto equals = c.words[k].find('=');
        const auto name = c.words[k].substr(0, equals);
        const auto value = equals == std::string::npos ? std::nullopt : parse_number(std::string_view(c.words[k]).substr(equals + 1));
        if (!value || (name != "seed" && name != "process" && name != "mismatch"))
            return error_at(c.location, ".mc: '{}' must be seed=NUMBER, process=0|1 or mismatch=0|1", c.words[k]);
        if (name == "seed") {
            if (!(value->value >= 0 && value->value < 0x1p53))
                return error_at(c.location, ".mc: seed={:g} must be from 0 to 2^53", value->value);
            out.seed = static_cast<std::uint64_t>(value->value);
        }
        if (name == "process") out.has_process = value->value != 0;
        if (name == "mismatch") out.has_mismatch = value->value != 0;
    }
    return out;
}

ChipSample ChipSpec::sample(std::uint64_t chip) const {
    ChipSample out{seed, first_chip + chip, has_mismatch, {}};
    if (has_process) out.process = sample_process(seed, first_chip + chip);
    return out;
}

std::optional<ChipSample> chip_sample_of(const Circuit& c) {
    if (!c.mismatch_seed) return {};
    return ChipSpec{1, *c.mismatch_seed, true, true, c.chip}.sample(0);
}

Result<NetlistVariants> NetlistVariants::create(const Netlist& netlist) {
    NetlistVariants out{};
    out.netlist_ = netlist;
    out.nominal_ = std::make_shared<const Circuit>(TRY(netlist.elaborate()));
    double count = 1;  // of the variants so far
    for (const auto& c : out.nominal_->directives) {
        if (c.name == "step") {
            out.axes_.push_back(TRY(read_axis(c)));
            count *= static_cast<double>(out.axes_.back().values.size());
        } else if (c.name == "mc") {
            out.chips_ = TRY(parse_chip_spec(c));
            if (!(out.chips_.count >= 1)) return error_at(c.location, ".mc: the number of chips must be at least 1");
            count *= out.chips_.count;
            out.chips_.count = std::floor(out.chips_.count);
        }
        if (!(count <= max_variants)) return too_many(c, count);
    }
    return out;
}

std::size_t NetlistVariants::count() const {
    std::size_t count = std::max<std::size_t>(static_cast<std::size_t>(chips_.count), 1);
    for (const auto& axis : axes_) count *= axis.values.size();
    return count;
}

Result<void> NetlistVariants::elaborate_step(std::size_t number) {
    if (last_ && last_->number == number) return {};
    if (axes_.empty()) {
        last_ = {number, "", {}, {}, nominal_};
        return {};
    }
    Values parameters;
    std::optional<double> temperature;
    std::string label;
    auto rest = number;  // the number without the digits of the axes that are done
    for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
        const double value = axis->values[rest % axis->values.size()];
        rest /= axis->values.size();
        axis->name == "temp" ? void(temperature = value) : void(parameters[axis->name] = value);
        label = fmt::format("{}={:g}{}{}", axis->name, value, label.empty() ? "" : " ", label);
    }
    last_ = {number, std::move(label), std::move(parameters), temperature, nullptr};
    last_->circuit = TRY(elaborate_last({}));
    return {};
}

/// The circuit of the combination `last_`.
Result<std::shared_ptr<const Circuit>> NetlistVariants::elaborate_last(std::optional<RandomDraws> draws) const {
    auto circuit = TRY(netlist_.elaborate(last_->parameters, draws));
    if (last_->temperature) circuit.temperature = *last_->temperature;
    return std::make_shared<const Circuit>(std::move(circuit));
}

/// The circuit of the combination `last_` with the random values of a chip.
Result<std::shared_ptr<const Circuit>> NetlistVariants::draw_chip(const ChipSample& chip) const {
    return elaborate_last(RandomDraws{chip.seed, chip.chip, chips_.has_process, chips_.has_mismatch});
}

Result<Variant> NetlistVariants::at(std::size_t number) {
    const std::size_t chip_count = std::max<std::size_t>(static_cast<std::size_t>(chips_.count), 1), chip = number % chip_count;
    TRY(elaborate_step(number / chip_count));
    Variant out{last_->label, last_->circuit, {}};
    out.sample = chip_sample_of(*out.circuit);
    if (!this->has_chips()) return out;
    out.sample = chips_.sample(chip);
    if (out.circuit->has_random_values) out.circuit = TRY(draw_chip(*out.sample));
    out.label += fmt::format("{}mc={}", out.label.empty() ? "" : " ", chip + 1);
    return out;
}

}  // namespace corpuscle::circuit
