#pragma once
// The cells of skin between which contact waves travel: squares of wave_cell_side. Sites and afferents of one cell send and feel the same
// wave.

#include <cmath>
#include <compare>
#include <map>

#include "skin/plan/sites.hpp"

namespace corpuscle {

inline constexpr double wave_cell_side = 5e-3;  ///< m; choice: a wave of 8 m/s crosses it in 0.6 ms

/// The column and row of a cell.
struct WaveCell {
    std::int32_t column, row;
    auto operator<=>(const WaveCell&) const = default;
};

/// Divides the plane into cells. The centre of cell (0, 0) is at the smallest coordinates of the sites.
class WaveGrid {
    double left_, low_;

public:
    explicit WaveGrid(const Sites& sites) : left_(sites.positions[0].x), low_(sites.positions[0].y) {
        for (const auto& p : sites.positions) left_ = std::min(left_, p.x), low_ = std::min(low_, p.y);
    }
    WaveCell cell_of(const Position& p) const {
        const auto index = [](double from_first) { return static_cast<std::int32_t>(std::floor(from_first / wave_cell_side + 0.5)); };
        return {index(p.x - left_), index(p.y - low_)};
    }
};

/// Distinct cells, numbered in the order in which they were first requested.
class WaveCellList {
    std::map<WaveCell, std::uint32_t> index_;

public:
    std::vector<WaveCell> cells = {};
    std::uint32_t index_of(const WaveCell& cell) {
        const auto [at, is_new] = index_.try_emplace(cell, static_cast<std::uint32_t>(cells.size()));
        if (is_new) cells.push_back(cell);
        return at->second;
    }
};

}  // namespace corpuscle
