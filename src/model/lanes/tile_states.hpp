#pragma once
// The states of a population, tile by tile: of the receptors, of the neurons, and whether the tile is at rest.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "model/lanes/aligned_buffer.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

template <class V>
class TileStates {
    std::size_t receptor_values_, neuron_values_;  // number of values per tile; those of the neurons of output 1 follow those of output 0
    AlignedBuffer<V> receptors_, neurons_;
    std::vector<std::uint8_t> at_rest_;

    /// True if all values are finite. Eight separate sums let the compiler vectorise the loop; `count` is a multiple of tile_size.
    static bool all_finite_in(const V* states, std::size_t count) {
        V sums[8] = {};
        for (std::size_t k = 0; k < count; k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += states[k + l] - states[k + l];  // NaN if the value is NaN or infinite
        return std::all_of(std::begin(sums), std::end(sums), [](V x) { return x == 0; });
    }
    static bool lane_has_non_finite(const V* states, std::size_t count, std::size_t lane) {
        for (std::size_t k = lane; k < count; k += tile_size)
            if (!std::isfinite(states[k])) return true;
        return false;
    }

public:
    /// The last two arguments are the numbers of state values of one afferent.
    TileStates(std::size_t tiles, std::size_t receptor_values, std::size_t neuron_values)
        : receptor_values_(receptor_values * tile_size), neuron_values_(neuron_values * tile_size), receptors_(tiles * receptor_values_),
          neurons_(tiles * neuron_values_), at_rest_(tiles) {}

    V* receptor(std::size_t tile) const { return receptors_.data() + tile * receptor_values_; }
    V* neuron(std::size_t tile) const { return neurons_.data() + tile * neuron_values_; }

    /// True if the state of the tile cannot change without force.
    bool is_at_rest(std::size_t tile) const { return at_rest_[tile]; }
    void set_at_rest(std::size_t tile, bool rests) { at_rest_[tile] = rests; }

    /// Copies the state of a tile to `to`.
    void copy(std::size_t tile, std::vector<V>& to) const {
        to.resize(receptor_values_ + neuron_values_);
        std::copy_n(receptor(tile), receptor_values_, to.data());
        std::copy_n(neuron(tile), neuron_values_, to.data() + receptor_values_);
    }
    void restore(std::size_t tile, const std::vector<V>& from) {
        std::copy_n(from.data(), receptor_values_, receptor(tile));
        std::copy_n(from.data() + receptor_values_, neuron_values_, neuron(tile));
    }
    /// True if the state of a tile is bitwise equal to one that copy() has saved.
    bool equals(std::size_t tile, const std::vector<V>& saved) const {
        return std::memcmp(receptor(tile), saved.data(), receptor_values_ * sizeof(V)) == 0 &&
               std::memcmp(neuron(tile), saved.data() + receptor_values_, neuron_values_ * sizeof(V)) == 0;
    }

    bool all_finite(std::size_t tile) const {
        return all_finite_in(receptor(tile), receptor_values_) && all_finite_in(neuron(tile), neuron_values_);
    }
    /// True if the state of one afferent contains NaN or infinity.
    bool has_non_finite(std::size_t afferent) const {
        const std::size_t tile = afferent / tile_size, lane = afferent % tile_size;
        return lane_has_non_finite(receptor(tile), receptor_values_, lane) || lane_has_non_finite(neuron(tile), neuron_values_, lane);
    }

    /// Number of values that save() appends.
    std::size_t size() const { return receptors_.size() + neurons_.size() + at_rest_.size(); }
    void save(std::vector<double>& to) const {
        to.insert(to.end(), receptors_.data(), receptors_.data() + receptors_.size());
        to.insert(to.end(), neurons_.data(), neurons_.data() + neurons_.size());
        to.insert(to.end(), at_rest_.begin(), at_rest_.end());
    }
    /// Restores the states from the size() values of save(). Returns false, and changes nothing, if they cannot be a saved state.
    bool resume(std::span<const double> saved) {
        const auto states = saved.first(saved.size() - at_rest_.size()), rests = saved.last(at_rest_.size());
        if (!std::all_of(states.begin(), states.end(), [](double x) { return std::isfinite(static_cast<V>(x)); })) return false;
        if (!std::all_of(rests.begin(), rests.end(), [](double x) { return x == 0 || x == 1; })) return false;
        std::transform(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(receptors_.size()), receptors_.data(),
                       [](double x) { return static_cast<V>(x); });
        std::transform(states.begin() + static_cast<std::ptrdiff_t>(receptors_.size()), states.end(), neurons_.data(),
                       [](double x) { return static_cast<V>(x); });
        std::transform(rests.begin(), rests.end(), at_rest_.begin(), [](double x) { return static_cast<std::uint8_t>(x); });
        return true;
    }
};

}  // namespace corpuscle::lanes
