#include "skin/fields_by_afferent.hpp"

#include <algorithm>

#include "model/lane_population.hpp"

namespace corpuscle {

void FieldsByAfferent::finish_counts() {
    for (std::size_t u = 1; u < begin_.size(); ++u) begin_[u] += begin_[u - 1];
    site_.resize(begin_.back()), weight_.resize(begin_.back());
    filled_ = begin_;
}

void FieldsByAfferent::add(std::size_t afferent, std::uint32_t site, double weight) {
    const std::size_t k = filled_[afferent]++;
    site_[k] = site, weight_[k] = weight;
}

void FieldsByAfferent::compute_tile(std::size_t tile, std::span<const double* const> site_rows, std::size_t steps, double* rows) const {
    const std::size_t first = tile * tile_width, size = std::min(tile_width, begin_.size() - 1 - first);
    if (size < tile_width) std::fill_n(rows, steps * tile_width, 0.0);
    for (std::size_t u = 0; u < size; ++u) {
        const auto begin = begin_[first + u], count = begin_[first + u + 1] - begin;
        lanes_.sum_afferent(site_.data() + begin, weight_.data() + begin, count, site_rows.data(), steps, rows + u, tile_width);
    }
}

}  // namespace corpuscle
