#include "skin/wave/contact_wave.hpp"

#include <fmt/format.h>
#include <array>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

constexpr double min_weight = 1e-3;  // a wave of less than 1 mN for 1 N at its source is left out. Choice

/// The numbers of columns and rows of cells that the sites span.
WaveCell extent_of(const Sites& sites) {
    const WaveGrid grid(sites);
    WaveCell out{0, 0};
    for (const auto& p : sites.positions) {
        const auto cell = grid.cell_of(p);
        out = {std::max(out.column, cell.column), std::max(out.row, cell.row)};
    }
    return out;
}

}  // namespace

ContactWave::Paths::Paths(const WaveParams& wave, std::int32_t column_count, std::int32_t row_count, double dt) {
    // exp(-r/decay) alone would bring the gain to min_weight at this distance.
    const double max_distance = wave.decay * std::max(0.0, num::log(std::max(wave.gain, min_weight) / min_weight));
    // One cell more, because an afferent may be beside the sites.
    const auto reach = static_cast<std::int32_t>(max_distance / wave_cell_side) + 1;
    columns = std::min(column_count + 1, reach), rows = std::min(row_count + 1, reach);
    for (std::int32_t c = 0; c <= columns; ++c)
        for (std::int32_t r = 0; r <= rows; ++r) {
            const double distance = wave_cell_side * num::sqrt(static_cast<double>(c) * c + static_cast<double>(r) * r);
            const double weight = wave.gain * num::exp(-distance / wave.decay) / num::sqrt(1 + distance / wave.radius);
            const double delay = distance / (wave.speed * dt), steps = std::floor(delay);
            paths.emplace_back();
            if (weight < min_weight) continue;
            paths.back() = {static_cast<std::int64_t>(steps), weight * (1 - (delay - steps)), weight * (delay - steps)};
            max_delay = std::max(max_delay, paths.back().delay);
        }
}

const ContactWave::Path* ContactWave::Paths::between(const WaveCell& a, const WaveCell& b) const {
    const auto c = std::abs(a.column - b.column), r = std::abs(a.row - b.row);
    if (c > columns || r > rows) return nullptr;
    const auto& path = paths[static_cast<std::size_t>(c) * static_cast<std::size_t>(rows + 1) + static_cast<std::size_t>(r)];
    return path.weight == 0 && path.weight_before == 0 ? nullptr : &path;
}

Result<std::unique_ptr<ContactWave>> ContactWave::make(const Innervation& skin, std::size_t class_index, std::size_t first,
                                                       std::size_t count, double dt, InstructionSet set) {
    constexpr double max_samples = 1 << 26;  // of the history of all cells: 512 MB
    const auto& c = skin.plan.classes[class_index];
    const auto extent = extent_of(skin.plan.sites);
    Paths paths(c.wave, extent.column, extent.row, dt);
    if (static_cast<double>(paths.max_delay) * static_cast<double>(skin.plan.sites.size()) > max_samples)
        return bad_input(
            fmt::format("{}: a wave of {:g} m/s takes up to {} samples at {:g} Hz, too many to keep for {} sites; raise "
                        "wave_speed, or sample the force at a lower rate",
                        c.name, c.wave.speed, paths.max_delay, 1 / dt, skin.plan.sites.size()));
    return std::unique_ptr<ContactWave>(new ContactWave(skin, class_index, first, count, dt, set, std::move(paths)));
}

ContactWave::ContactWave(const Innervation& skin, std::size_t class_index, std::size_t first, std::size_t count, double dt,
                         InstructionSet set, Paths paths)
    : lanes_(lanes::field_kernels(set)), receptors_(skin.plan.classes[class_index].receptors()), paths_(std::move(paths)),
      sources_(skin.plan.sites, WaveGrid(skin.plan.sites), skin.plan.classes[class_index].wave.corner, dt,
               static_cast<std::size_t>(paths_.max_delay) + 1) {
    const WaveGrid grid(skin.plan.sites);
    for (std::size_t u = first; u < first + count; ++u)
        cell_of_afferent_.push_back(cells_.index_of(grid.cell_of(skin.afferents[skin.class_begin[class_index] + u].position)));
    has_wave_.resize(cells_.cells.size());
    waves_ = lanes::AlignedBuffer<double>(cells_.cells.size() * WaveSources::max_steps);
    zero_force_.resize((count + tile_width - 1) / tile_width * receptors_);
    rows_ = lanes::AlignedBuffer<double>(zero_force_.size() * tile_width * WaveSources::max_steps);
}

/// Computes the wave on the afferents of one cell. Sources whose change does not arrive in the block are left out.
void ContactWave::compute_cell(std::size_t cell, std::size_t steps, std::vector<lanes::DelayedTerm>& terms) {
    const auto end = sources_.step(), begin = end - static_cast<std::int64_t>(steps);
    terms.clear();
    for (const auto& s : sources_.sources()) {
        const auto* path = paths_.between(cells_.cells[cell], s.cell);
        if (!path || end - 1 - path->delay < s.first || begin - path->delay - 1 > s.last) continue;
        terms.push_back({s.now - path->delay, path->weight, path->weight_before});
    }
    has_wave_[cell] = !terms.empty();
    if (!terms.empty()) lanes_.sum_delayed(terms.data(), terms.size(), steps, waves_.data() + cell * WaveSources::max_steps);
}

void ContactWave::compute(const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps,
                          ThreadPool& pool) {
    constexpr std::size_t cells_per_task = 32;
    sources_.advance(force, touched, at, steps);
    if (sources_.sources().empty()) {
        std::fill(has_wave_.begin(), has_wave_.end(), char{0});
        return;
    }
    while (terms_.size() < pool.threads()) terms_.emplace_back().reserve(sources_.size());
    pool.for_each((cells_.cells.size() + cells_per_task - 1) / cells_per_task, [steps, this](std::size_t task, unsigned thread) {
        const auto from = task * cells_per_task, to = std::min(from + cells_per_task, cells_.cells.size());
        for (auto cell = from; cell < to; ++cell) compute_cell(cell, steps, terms_[thread]);
    });
}

/// Writes the rows of one tile of forces: those from receptive fields, and the wave.
void ContactWave::add_to_tile(std::size_t tile, const TileCall& call) {
    const auto& [direct, steps] = call;
    const std::size_t begin = tile / receptors_ * tile_width, end = std::min(cell_of_afferent_.size(), begin + tile_width);
    const std::size_t row = tile * tile_width * steps;
    const bool is_direct = direct.zero_force[tile] == 0;
    bool is_reached = false;
    for (std::size_t u = begin; u < end; ++u) is_reached = is_reached || has_wave_[cell_of_afferent_[u]];
    zero_force_[tile] = !is_direct && !is_reached;
    if (zero_force_[tile]) return;
    static constexpr std::array<double, std::max(tile_width, WaveSources::max_steps)> zeros = {};
    std::array<const double*, tile_width> waves{};
    waves.fill(zeros.data());
    for (std::size_t u = begin; u < end; ++u)
        if (const double* const wave = force_on(u)) waves[u - begin] = wave;
    lanes_.transpose(waves.data(), steps, is_direct ? direct.rows + row : zeros.data(), is_direct ? tile_width : 0, rows_.data() + row);
}

ForceTiles<double> ContactWave::add(ForceTiles<double> direct, const SiteForce& force, std::span<const std::uint32_t> touched,
                                    std::size_t at, std::size_t steps, ThreadPool& pool) {
    compute(force, touched, at, steps, pool);
    if (sources_.sources().empty()) return direct;
    const TileCall call{direct, steps};  // one reference: a larger capture would allocate memory in each call
    pool.for_each(zero_force_.size(), [&call, this](std::size_t tile, unsigned) { add_to_tile(tile, call); });
    return {rows_.data(), zero_force_.data()};
}

}  // namespace corpuscle
