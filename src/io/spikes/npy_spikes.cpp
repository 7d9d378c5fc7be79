#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "io/recording/recording_formats.hpp"
#include "io/spikes/train_collector.hpp"
#include "io/table/foreign_format.hpp"

namespace corpuscle {
namespace {

/// The name of an afferent or channel that is identified by a number: the number as text.
std::string name_of_number(double x) { return std::floor(x) == x ? fmt::format("{:.0f}", x) : fmt::format("{}", x); }

/// True if the times look like sample numbers instead of seconds. spike_times.npy of Phy (a program for spike sorting) has sample numbers,
/// and does not contain the rate.
bool are_sample_numbers(const std::vector<double>& times) {
    return times.size() > 1 && *std::max_element(times.begin(), times.end()) >= 1000 &&
           std::all_of(times.begin(), times.end(), [](double t) { return std::floor(t) == t; });
}

}  // namespace

Result<std::vector<NamedTrain>> read_npy_spikes(const std::string& path, const SpikeColumns& wanted) {
    auto table = TRY(open_npy_table(path));
    std::vector<std::string> headings;
    for (const auto& c : table->columns()) headings.push_back(c.unit.empty() ? c.name : c.name + "_" + c.unit);
    if (headings.size() == 1) headings[0].clear();  // a single column holds the times; its name does not matter
    // ch1, ch2 ... are the default names of columns without names.
    const bool is_unnamed = headings.size() > 1 && headings[0] == "ch1";
    if (is_unnamed && !(wanted.time && wanted.train))
        return bad_input(
            fmt::format("the array has {} columns; select the columns of times and trains, such as --time 1 --train 2", headings.size()),
            {path});
    std::size_t column = 0;
    const auto found = find_spike_columns(headings, wanted, column);
    if (!found) return bad_input(found.error().message, {path});
    std::vector<std::size_t> columns = {found->time};
    if (found->afferent) columns.push_back(*found->afferent);
    if (found->channel) columns.push_back(*found->channel);
    TrainCollector trains;
    std::vector<double> stored_times;
    for (std::vector<std::vector<double>> block(columns.size());;) {
        const auto rows = TRY(table->read(columns, rows_per_block, block));
        if (rows == 0) break;
        for (std::size_t k = 0; k < rows; ++k) {
            const auto afferent = found->afferent ? name_of_number(block[1][k]) : std::string();
            const auto channel = found->channel ? name_of_number(block.back()[k]) : std::string();
            trains.train(afferent, channel).push_back(block[0][k] * found->seconds_per_unit);
            stored_times.push_back(block[0][k]);
        }
    }
    if (found->seconds_per_unit == 1 && are_sample_numbers(stored_times))
        return bad_input(
            fmt::format("the times are integers, as sample numbers are. Convert them to seconds with the sample rate: python3 -c "
                        "\"import numpy; numpy.save('seconds.npy', numpy.load('{}') / 30000)\"",
                        path.find_first_of("'\"\\$`!") == path.npos ? path : "FILE.npy"),
            {path});
    return std::move(trains).sorted();
}

}  // namespace corpuscle
