#pragma once
// The states of a population, tile by tile: of the receptors, of the neurons, and whether the tile is at rest.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "model/lanes/aligned_buffer.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

template <class V>
class TileStates {
    std::size_t receptor_values_, tile_values_;  // number of values per tile: of its receptors; of its receptors, then its neurons
    AlignedBuffer<V> values_;
    std::vector<std::uint8_t> at_rest_;

    /// Calls f with the values of the receptors of each tile, then with those of the neurons of each tile: the order of a saved state.
    template <class F>
    void for_each_part(F f) const {
        for (std::size_t tile = 0; tile < at_rest_.size(); ++tile) f(std::span(receptor(tile), receptor_values_));
        for (std::size_t tile = 0; tile < at_rest_.size(); ++tile) f(std::span(neuron(tile), tile_values_ - receptor_values_));
    }

public:
    /// The last two arguments are the numbers of state values of one afferent.
    TileStates(std::size_t tiles, std::size_t receptor_values, std::size_t neuron_values)
        : receptor_values_(receptor_values * tile_size), tile_values_((receptor_values + neuron_values) * tile_size),
          values_(tiles * tile_values_), at_rest_(tiles) {}

    V* receptor(std::size_t tile) const { return values_.data() + tile * tile_values_; }
    V* neuron(std::size_t tile) const { return receptor(tile) + receptor_values_; }  ///< those of output 1 follow those of output 0

    /// True if the state of the tile cannot change without force.
    bool is_at_rest(std::size_t tile) const { return at_rest_[tile]; }
    void set_at_rest(std::size_t tile, bool rests) { at_rest_[tile] = rests; }

    /// Copies the state of a tile to `to`.
    void copy(std::size_t tile, std::vector<V>& to) const { to.assign(receptor(tile), receptor(tile) + tile_values_); }
    void restore(std::size_t tile, const std::vector<V>& from) { std::copy(from.begin(), from.end(), receptor(tile)); }
    /// True if the state of a tile is bitwise equal to one that copy() has saved.
    bool equals(std::size_t tile, const std::vector<V>& saved) const {
        return std::memcmp(receptor(tile), saved.data(), tile_values_ * sizeof(V)) == 0;
    }

    /// True if all values of a tile are finite. Eight separate sums let the compiler vectorise the loop.
    bool all_finite(std::size_t tile) const {
        const V* const states = receptor(tile);
        V sums[8] = {};
        for (std::size_t k = 0; k < tile_values_; k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += states[k + l] - states[k + l];  // NaN if the value is NaN or infinite
        return std::all_of(std::begin(sums), std::end(sums), [](V x) { return x == 0; });
    }
    /// True if the state of one afferent contains NaN or infinity.
    bool has_non_finite(std::size_t afferent) const {
        const V* const states = receptor(afferent / tile_size);
        for (std::size_t k = afferent % tile_size; k < tile_values_; k += tile_size)
            if (!std::isfinite(states[k])) return true;
        return false;
    }

    /// Number of values that save() appends.
    std::size_t size() const { return values_.size() + at_rest_.size(); }
    void save(std::vector<double>& to) const {
        for_each_part([&](std::span<V> part) { to.insert(to.end(), part.begin(), part.end()); });
        to.insert(to.end(), at_rest_.begin(), at_rest_.end());
    }
    /// Restores the states from the size() values of save(). Returns false, and changes nothing, if they cannot be a saved state.
    bool resume(std::span<const double> saved) {
        const auto states = saved.first(values_.size()), rests = saved.last(at_rest_.size());
        if (!std::all_of(states.begin(), states.end(), [](double x) { return std::isfinite(static_cast<V>(x)); })) return false;
        if (!std::all_of(rests.begin(), rests.end(), [](double x) { return x == 0 || x == 1; })) return false;
        auto from = states.begin();
        for_each_part([&](std::span<V> part) {
            for (V& x : part) x = static_cast<V>(*from++);
        });
        std::transform(rests.begin(), rests.end(), at_rest_.begin(), [](double x) { return static_cast<std::uint8_t>(x); });
        return true;
    }
};

}  // namespace corpuscle::lanes
