#pragma once
// The states of a population, tile by tile: receptors, neurons, and which tiles are at rest.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "model/lanes/buffer.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

template <class V>
class TileStates {
    std::size_t felt_, own_;  // values of a tile: of the receptors; of the neurons of all outputs, one after another
    Buffer<V> receptors_, neurons_;
    std::vector<std::uint8_t> rests_;

    /// True if all values are finite. Eight sums at a time, which vectorises.
    static bool finite(const V* states, std::size_t count) {
        V sums[8] = {};
        for (std::size_t k = 0; k < count; k += 8)
            for (std::size_t l = 0; l < 8; ++l) sums[l] += states[k + l] - states[k + l];  // 0, or NaN
        return std::all_of(std::begin(sums), std::end(sums), [](V x) { return x == 0; });
    }
    static bool lost(const V* states, std::size_t count, std::size_t lane) {
        for (std::size_t k = lane; k < count; k += tile_units)
            if (!std::isfinite(states[k])) return true;
        return false;
    }

public:
    TileStates(std::size_t tiles, std::size_t felt, std::size_t own)
        : felt_(felt * tile_units), own_(own * tile_units), receptors_(tiles * felt_), neurons_(tiles * own_), rests_(tiles) {}

    V* receptor(std::size_t tile) const { return receptors_.data() + tile * felt_; }
    V* neuron(std::size_t tile) const { return neurons_.data() + tile * own_; }

    /// True if the state of the tile cannot change without force.
    bool rests(std::size_t tile) const { return rests_[tile]; }
    void set_rest(std::size_t tile, bool rests) { rests_[tile] = rests; }

    void copy(std::size_t tile, std::vector<V>& to) const {
        to.resize(felt_ + own_);
        std::copy_n(receptor(tile), felt_, to.data());
        std::copy_n(neuron(tile), own_, to.data() + felt_);
    }
    void put_back(std::size_t tile, const std::vector<V>& from) {
        std::copy_n(from.data(), felt_, receptor(tile));
        std::copy_n(from.data() + felt_, own_, neuron(tile));
    }
    /// Bitwise comparison.
    bool is(std::size_t tile, const std::vector<V>& as) const {
        return std::memcmp(receptor(tile), as.data(), felt_ * sizeof(V)) == 0 &&
               std::memcmp(neuron(tile), as.data() + felt_, own_ * sizeof(V)) == 0;
    }

    bool all_numbers(std::size_t tile) const { return finite(receptor(tile), felt_) && finite(neuron(tile), own_); }
    /// True if the state of one afferent contains NaN or infinity.
    bool is_lost(std::size_t afferent) const {
        const std::size_t tile = afferent / tile_units, lane = afferent % tile_units;
        return lost(receptor(tile), felt_, lane) || lost(neuron(tile), own_, lane);
    }

    std::size_t size() const { return receptors_.size() + neurons_.size() + rests_.size(); }
    void save(std::vector<double>& to) const {
        to.insert(to.end(), receptors_.data(), receptors_.data() + receptors_.size());
        to.insert(to.end(), neurons_.data(), neurons_.data() + neurons_.size());
        to.insert(to.end(), rests_.begin(), rests_.end());
    }
    /// Restores size() values. Returns false, and changes nothing, if they cannot be a saved state.
    bool resume(std::span<const double> saved) {
        const auto states = saved.first(saved.size() - rests_.size()), rests = saved.last(rests_.size());
        if (!std::all_of(states.begin(), states.end(), [](double x) { return std::isfinite(static_cast<V>(x)); })) return false;
        if (!std::all_of(rests.begin(), rests.end(), [](double x) { return x == 0 || x == 1; })) return false;
        std::transform(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(receptors_.size()), receptors_.data(),
                       [](double x) { return static_cast<V>(x); });
        std::transform(states.begin() + static_cast<std::ptrdiff_t>(receptors_.size()), states.end(), neurons_.data(),
                       [](double x) { return static_cast<V>(x); });
        std::transform(rests.begin(), rests.end(), rests_.begin(), [](double x) { return static_cast<std::uint8_t>(x); });
        return true;
    }
};

}  // namespace corpuscle::lanes
