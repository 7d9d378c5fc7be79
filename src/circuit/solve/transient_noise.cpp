#include "circuit/solve/transient_noise.hpp"

#include "core/random.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double radius = 0.5e-3;  // V or A: the density of a device is computed again after an unknown has changed by this

constexpr std::int64_t no_index = std::numeric_limits<std::int64_t>::min();  // of a level whose deviates are not drawn

const auto white_purpose = static_cast<std::uint32_t>(stream_id("white noise of devices"));
const auto flicker_purpose = static_cast<std::uint32_t>(stream_id("flicker noise of devices"));

/// The standard deviation of the deviates of a level. A piecewise linear current between deviates of variance s^2 at intervals D has the
/// density 2 s^2 D sinc^4(f D). Summed over D = 2^k it is s^2 (2/3) / (f ln 2).
const double level_deviation = std::sqrt(1.5 * std::log(2.0));

/// Sets value(k) of each of `count` sources to a deviate. Two sources share the pair of one counter.
template <class Value>
void draw(std::uint64_t seed, std::uint32_t purpose, std::uint64_t index, std::size_t count, const Value& value) {
    for (std::size_t k = 0; k < count; k += 2) {
        const auto pair = normal_pair(seed, static_cast<std::uint32_t>(k / 2), purpose, index);
        value(k) = pair.first;
        if (k + 1 < count) value(k + 1) = pair.second;
    }
}

}  // namespace

TransientNoise::TransientNoise(const System& system, const NoisePlan& plan) : system_(system), plan_(plan) {
    const std::vector<double> zeros(static_cast<std::size_t>(system.size()));
    for (const auto& device : system.devices()) {
        const auto noise = device->noise(system.terminal_values(*device, zeros));
        if (!noise.empty()) add_device(*device, noise);
    }
    if (flicker_sources_.empty()) return;
    for (int shift = 0;; ++shift) {
        const double length = std::ldexp(plan.interval(), shift);  // s
        levels_.push_back({shift, 0, no_index, (shift == 0 ? std::sqrt(2.0) : 1) * level_deviation, {}, {}});
        for (auto* deviates : {&levels_.back().low, &levels_.back().high}) deviates->resize(flicker_sources_.size());
        if (length >= 0.5 / plan.fmin) return;
    }
}

void TransientNoise::begin(std::span<const double> x, std::uint64_t stream) {
    const auto low = [](std::uint64_t n) { return static_cast<std::uint32_t>(n); };
    const auto words = philox({low(stream), low(stream >> 32), 0, white_purpose}, plan_.seed);
    key_ = std::uint64_t{words[0]} << 32 | words[1];
    for (auto& level : levels_) {
        const auto random = philox({static_cast<std::uint32_t>(level.shift), 0, 0, flicker_purpose}, key_)[0];
        level.offset = static_cast<std::int64_t>(random & ((std::uint64_t{1} << std::min(level.shift, 32)) - 1)), level.index = no_index;
    }
    cell_ = -1, origin_ = 0;
    update(x, true);
}

void TransientNoise::add_device(const Device& device, std::span<const NoiseSource> noise) {
    devices_.push_back({&device, sources_.size(), noise.size(), {}});
    for (const auto& n : noise) {
        if (n.has_flicker) flicker_sources_.push_back(sources_.size());
        sources_.push_back({device.unknowns[n.from], device.unknowns[n.to]});
    }
}

void TransientNoise::set_densities(const NoisyDevice& d, std::span<const NoiseSource> noise) {
    for (std::size_t k = 0; k < d.count; ++k) {
        auto& source = sources_[d.first + k];
        source.white = plan_.scale * std::sqrt(std::max(noise[k].white, 0.0) * plan_.fmax);
        source.flicker = plan_.scale * std::sqrt(std::max(noise[k].flicker, 0.0));
    }
}

void TransientNoise::update(std::span<const double> x, bool all) {
    for (auto& d : devices_) {
        const auto& unknowns = d.device->unknowns;
        bool moved = all || d.v.empty();
        for (std::size_t k = 0; k < unknowns.size() && !moved; ++k) moved = std::abs(value_of(x, unknowns[k]) - d.v[k]) > radius;
        if (!moved) continue;
        d.v.resize(unknowns.size());
        for (std::size_t k = 0; k < unknowns.size(); ++k) d.v[k] = value_of(x, unknowns[k]);
        set_densities(d, d.device->noise(d.v));
    }
}

void TransientNoise::archive(StateArchive& a) {
    a.number(origin_);
    for (auto& d : devices_) {
        a.numbers(d.v, d.device->unknowns.size());
        if (a.is_reader() && a.is_valid) set_densities(d, d.device->noise(d.v));
    }
}

std::int64_t TransientNoise::cell_at(double t) const {
    constexpr double rounding = 1e-6;  // of an interval: a step that ends this close before the end of an interval ends there
    return static_cast<std::int64_t>(std::floor((t + origin_) / plan_.interval() + rounding));
}

double TransientNoise::next_sample(double t) const { return static_cast<double>(cell_at(t) + 1) * plan_.interval() - origin_; }

void TransientNoise::draw_level(const Level& level, std::int64_t index, std::vector<double>& out) const {
    draw(key_, flicker_purpose + 1 + static_cast<std::uint32_t>(level.shift), static_cast<std::uint64_t>(index), out.size(),
         [&](std::size_t k) -> double& { return out[k]; });
}

void TransientNoise::load_level(Level& level, std::int64_t index) {
    if (index == level.index) return;
    if (index == level.index + 1)
        std::swap(level.low, level.high);
    else
        draw_level(level, index, level.low);
    draw_level(level, index + 1, level.high);
    level.index = index;
}

void TransientNoise::load_cell(std::int64_t cell) {
    if (cell == std::exchange(cell_, cell)) return;
    draw(key_, white_purpose, static_cast<std::uint64_t>(cell), sources_.size(),
         [&](std::size_t k) -> double& { return sources_[k].deviate; });
    for (const auto k : flicker_sources_) sources_[k].at_start = sources_[k].growth = 0;
    for (auto& level : levels_) {
        const auto position = cell + level.offset, length = std::int64_t{1} << level.shift;
        load_level(level, position >> level.shift);
        const double per_cell = 1 / static_cast<double>(length), part = static_cast<double>(position & (length - 1)) * per_cell;
        for (std::size_t j = 0; j < flicker_sources_.size(); ++j) {
            auto& source = sources_[flicker_sources_[j]];
            const double change = level.weight * (level.high[j] - level.low[j]);
            source.at_start += level.weight * level.low[j] + change * part, source.growth += change * per_cell;
        }
    }
}

void TransientNoise::charges(double t0, double t1, std::span<double> out) {
    std::fill(out.begin(), out.end(), 0.0);
    const auto cell = cell_at(t0);
    load_cell(cell);
    const double middle = (0.5 * (t0 + t1) + origin_) / plan_.interval() - static_cast<double>(cell);  // 0 to 1 in the cell
    for (const auto& s : sources_) {
        const double charge = (s.white * s.deviate + s.flicker * (s.at_start + s.growth * middle)) * (t1 - t0);
        if (s.from >= 0) out[static_cast<std::size_t>(s.from)] += charge;
        if (s.to >= 0) out[static_cast<std::size_t>(s.to)] -= charge;
    }
}

}  // namespace corpuscle::circuit
