#include "skin/field_units.hpp"

#include <algorithm>

#include "model/population.hpp"

namespace corpuscle {

void FieldsByUnit::counted() {
    for (std::size_t u = 1; u < begin_.size(); ++u) begin_[u] += begin_[u - 1];
    site_.resize(begin_.back()), weight_.resize(begin_.back());
    filled_ = begin_;
}

void FieldsByUnit::add(std::size_t afferent, std::uint32_t site, double weight) {
    const std::size_t k = filled_[afferent]++;
    site_[k] = site, weight_[k] = weight;
}

void FieldsByUnit::feel_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const {
    const std::size_t first = tile * force_tile, size = std::min(force_tile, begin_.size() - 1 - first);
    if (size < force_tile) std::fill_n(rows, steps * force_tile, 0.0);
    for (std::size_t u = 0; u < size; ++u) {
        const auto begin = begin_[first + u], count = begin_[first + u + 1] - begin;
        lanes_.add_unit(site_.data() + begin, weight_.data() + begin, count, site_rows.data(), steps, rows + u, force_tile);
    }
}

}  // namespace corpuscle
