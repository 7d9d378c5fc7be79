#include "sweep/spec/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sweep/spec/axis.hpp"
#include "sweep/spec/mismatch_samples.hpp"

namespace corpuscle {
namespace {

constexpr double no_mean = std::numeric_limits<double>::quiet_NaN();

/// The index of a row's value among the listed values of the axis; the number of listed values if it is not among them.
std::size_t level_of(const SweepTable& table, std::size_t axis, std::size_t row) {
    const auto& values = table.points[axis];
    const double x = table.axis_values[axis][row];
    const auto at = std::lower_bound(values.begin(), values.end(), x);
    return at != values.end() && *at == x ? static_cast<std::size_t>(at - values.begin()) : values.size();
}

/// The stored text of the sweep file without the lines for options of the command line ("--seed 3").
std::string file_text(const std::string& stored) {
    std::string out;
    for (std::size_t from = 0; from < stored.size();) {
        const auto end = std::min(stored.find('\n', from), stored.size() - 1) + 1;
        if (stored.compare(from, 2, "--") != 0) out += stored.substr(from, end - from);
        from = end;
    }
    return out;
}

}  // namespace

bool is_deterministic(const SweepResults& results) {
    if (!results.about(mismatch_metadata_name).empty() || results.axes.empty()) return false;
    for (const auto& axis : results.axes)
        if (axis.name.starts_with("process.")) return false;
    const auto stored = results.about("sweep file");  // empty if the sweep was a netlist with .step or .mc, without a sweep file
    const auto text = sweeps::read_sweep_text(file_text(stored), results.path());
    if (!text) return false;
    const auto axes = text->axes();
    return std::none_of(axes.begin(), axes.end(), [](const ConfigNode& axis) {
        return sweeps::axis_name(axis).text == "process" || sweeps::axis_name(axis).text == "mismatch" || sweeps::is_sampled(axis);
    });
}

std::vector<AxisEffect> axis_effects(const SweepTable& table, const std::vector<double>& measure) {
    double sum = 0, count = 0, squares = 0;
    for (const double x : measure)
        if (std::isfinite(x)) sum += x, ++count;
    for (const double x : measure)
        if (std::isfinite(x)) squares += (x - sum / count) * (x - sum / count);
    std::vector<AxisEffect> out;
    if (!(squares > 0)) return out;
    for (std::size_t a = 0; a < table.axes.size(); ++a) {
        if (table.points[a].size() < 2) continue;
        AxisEffect effect{a, 0, {}};
        std::vector<double> sums(table.points[a].size() + 1), counts(sums.size());  // the last is for values that are not listed
        for (std::size_t r = 0; r < measure.size(); ++r)
            if (std::isfinite(measure[r])) {
                const auto level = level_of(table, a, r);
                sums[level] += measure[r], ++counts[level];
            }
        for (std::size_t k = 0; k < table.points[a].size(); ++k) {
            effect.means.push_back(counts[k] > 0 ? sums[k] / counts[k] : no_mean);
            const double deviation = counts[k] > 0 ? effect.means[k] - sum / count : 0;
            effect.fraction += counts[k] * deviation * deviation / squares;
        }
        out.push_back(std::move(effect));
    }
    std::sort(out.begin(), out.end(),
              [](const AxisEffect& x, const AxisEffect& y) { return std::pair(-x.fraction, x.axis) < std::pair(-y.fraction, y.axis); });
    return out;
}

std::vector<std::vector<double>> means_over(const SweepTable& table, const std::vector<double>& measure, std::size_t a, std::size_t b) {
    const auto rows = table.points[a].size(), columns = table.points[b].size();
    std::vector<std::vector<double>> sums(rows, std::vector<double>(columns)), counts = sums;
    for (std::size_t r = 0; r < measure.size(); ++r) {
        const auto i = level_of(table, a, r), j = level_of(table, b, r);
        if (std::isfinite(measure[r]) && i < rows && j < columns) sums[i][j] += measure[r], ++counts[i][j];
    }
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) sums[i][j] = counts[i][j] > 0 ? sums[i][j] / counts[i][j] : no_mean;
    return sums;
}

}  // namespace corpuscle
