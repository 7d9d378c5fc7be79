#include "skin/field_units.hpp"

#include <algorithm>
#include <cstring>

#include "model/population.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t at_once = 16;  // steps: their sums stay in registers
using TwoSums [[gnu::vector_size(16)]] = double;

}  // namespace

void FieldsByUnit::counted() {
    for (std::size_t u = 1; u < begin_.size(); ++u) begin_[u] += begin_[u - 1];
    site_.resize(begin_.back()), weight_.resize(begin_.back());
    filled_ = begin_;
}

void FieldsByUnit::add(std::size_t unit, std::uint32_t site, double weight) {
    const std::size_t k = filled_[unit]++;
    site_[k] = site, weight_[k] = weight;
}

/// Into every force_tile-th of `column`.
void FieldsByUnit::feel_unit(std::size_t unit, std::span<const double* const> site_rows, std::size_t steps, double* column) const {
    std::size_t from = 0;
    for (; from + at_once <= steps; from += at_once) {
        TwoSums sum[at_once / 2] = {};
        for (std::size_t k = begin_[unit]; k < begin_[unit + 1]; ++k) {
            const double* const force = site_rows[site_[k]] + from;
            const TwoSums weight = {weight_[k], weight_[k]};
            for (std::size_t i = 0; i < at_once / 2; ++i) {
                TwoSums f;
                std::memcpy(&f, force + 2 * i, sizeof f);
                sum[i] += weight * f;
            }
        }
        for (std::size_t i = 0; i < at_once; ++i) column[(from + i) * force_tile] = sum[i / 2][i % 2];
    }
    for (; from < steps; ++from) {
        double sum = 0;
        for (std::size_t k = begin_[unit]; k < begin_[unit + 1]; ++k) sum += weight_[k] * site_rows[site_[k]][from];
        column[from * force_tile] = sum;
    }
}

void FieldsByUnit::feel_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const {
    const std::size_t first = tile * force_tile, units = std::min(force_tile, begin_.size() - 1 - first);
    if (units < force_tile) std::fill_n(rows, steps * force_tile, 0.0);
    for (std::size_t u = 0; u < units; ++u) feel_unit(first + u, site_rows, steps, rows + u);
}

}  // namespace corpuscle
