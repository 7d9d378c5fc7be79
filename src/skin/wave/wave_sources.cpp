#include "skin/wave/wave_sources.hpp"

#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min() / 2;

}  // namespace

WaveSources::WaveSources(const Sites& sites, const WaveGrid& grid, double corner, double dt, std::size_t history)
    : decay_(num::exp(-2 * 3.141592653589793 * corner * dt)), gain_(0.5 * (1 + decay_)), history_(history),
      capacity_(2 * history + 2 * max_steps), end_(history) {
    for (const auto& p : sites.positions) cell_of_site_.push_back(cells_.index_of(grid.cell_of(p)));
    const auto cells = cells_.cells.size();
    state_.resize(cells), is_active_.resize(cells), changes_.resize(cells * capacity_);
    active_.reserve(cells), sources_.reserve(cells);
}

/// Adds the cells of these sites to the active ones, with a history of 0.
void WaveSources::activate(std::span<const std::uint32_t> touched) {
    const auto before = active_.size();
    for (const auto s : touched) {
        const auto cell = cell_of_site_[s];
        if (std::exchange(is_active_[cell], char{1})) continue;
        active_.push_back(cell);
        state_[cell].last = never;
        std::fill_n(changes_of(cell) + end_ - history_, history_, 0.0);
    }
    if (active_.size() > before) std::sort(active_.begin(), active_.end());
}

/// True if the cell has no force and has not changed within the history.
bool WaveSources::is_at_rest(const Cell& cell) const {
    return cell.change == 0 && cell.force == 0 && step_ - 1 - cell.last >= static_cast<std::int64_t>(history_);
}

/// Replaces the force on a cell by its change: y[k] = d y[k-1] + (1 + d)/2 (F[k] - F[k-1]) with d = exp(-2 pi corner dt), and F[-1] = F[0].
/// The amplitude is correct at half the sampling rate.
void WaveSources::filter(Cell& cell, double* values, std::size_t steps) const {
    if (step_ == 0) cell.force = values[0];
    for (std::size_t k = 0; k < steps; ++k) {
        const double change = decay_ * cell.change + gain_ * (values[k] - cell.force);
        cell.force = values[k];
        cell.change = values[k] = num::abs(change) < min_change ? 0 : change;
        if (cell.change == 0) continue;
        const auto sample = step_ + static_cast<std::int64_t>(k);
        if (cell.last < step_ - static_cast<std::int64_t>(history_)) cell.first = sample;  // no block needs the last change
        cell.last = sample;
    }
}

void WaveSources::advance(const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps) {
    if (end_ + steps > capacity_) {
        for (const auto cell : active_) std::copy_n(changes_of(cell) + end_ - history_, history_, changes_of(cell));
        end_ = history_;
    }
    activate(touched);
    for (const auto cell : active_) std::fill_n(changes_of(cell) + end_, steps, 0.0);
    for (const auto s : touched) {
        double* const sum = changes_of(cell_of_site_[s]) + end_;
        const double* const f = force.data + s * force.stride + at;
        for (std::size_t k = 0; k < steps; ++k) sum[k] += f[k];
    }
    for (const auto cell : active_) filter(state_[cell], changes_of(cell) + end_, steps);
    end_ += steps, step_ += static_cast<std::int64_t>(steps);
    list_sources(steps);
}

/// Lists the cells that have changed, and removes those at rest from the active ones.
void WaveSources::list_sources(std::size_t steps) {
    const auto oldest = step_ - static_cast<std::int64_t>(steps + history_);
    sources_.clear();
    for (const auto cell : active_)
        if (const auto& s = state_[cell]; s.last >= oldest)
            sources_.push_back({cells_.cells[cell], changes_of(cell) + end_ - steps, s.first, s.last});
    std::erase_if(active_, [this](std::uint32_t cell) {
        if (!is_at_rest(state_[cell])) return false;
        is_active_[cell] = 0;
        return true;
    });
}

/// The number of samples, then for each active cell its number, the state of its high-pass, and its history.
std::vector<double> WaveSources::save() const {
    std::vector<double> out = {static_cast<double>(step_)};
    for (const auto cell : active_) {
        out.insert(out.end(), {static_cast<double>(cell), state_[cell].change, state_[cell].force});
        const double* const end = changes_.data() + cell * capacity_ + end_;
        out.insert(out.end(), end - history_, end);
    }
    return out;
}

bool WaveSources::resume(std::span<const double> saved) {
    const std::size_t each = 3 + history_;
    const auto all_finite = std::all_of(saved.begin(), saved.end(), [](double x) { return std::isfinite(x); });
    if (saved.empty() || (saved.size() - 1) % each != 0 || !all_finite || !(saved[0] >= 0 && saved[0] <= 0x1p53)) return false;
    for (const auto cell : active_) is_active_[cell] = 0, state_[cell] = {};
    active_.clear(), sources_.clear();
    step_ = static_cast<std::int64_t>(saved[0]), end_ = history_;
    double previous = -1;
    for (auto from = saved.subspan(1); !from.empty(); from = from.subspan(each)) {
        if (!(from[0] > previous && from[0] < static_cast<double>(state_.size())) || from[0] != std::floor(from[0])) return false;
        previous = from[0];
        const auto cell = static_cast<std::uint32_t>(from[0]);
        active_.push_back(cell), is_active_[cell] = 1;
        std::copy_n(from.begin() + 3, history_, changes_of(cell));
        auto& s = state_[cell] = {from[1], from[2], 0, never};
        for (std::size_t k = 0; k < history_; ++k)
            if (const auto sample = step_ - static_cast<std::int64_t>(history_ - k); from[3 + k] != 0)
                s.first = s.last == never ? sample : s.first, s.last = sample;
    }
    return true;
}

}  // namespace corpuscle
