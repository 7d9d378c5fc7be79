#include "fit/iv/iv_collector.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_points = 2'000'000;

struct PossibleRange {
    double low, high;
    std::string_view unit, heading, option;  ///< heading and option: examples of a unit

    bool contains(double x) const { return x >= low && x <= high; }
    std::string text() const { return fmt::format("outside [{:g}, {:g}] {}", low, high, unit); }
};
PossibleRange range_of(IvQuantity q) {
    switch (q) {
        case IvQuantity::width:
        case IvQuantity::length:
            return {1e-9, 1e-2, "m", "W (um)", "0.5um"};
        case IvQuantity::temperature:
            return {-273, 500, "C", "T (K)", "27"};
        case IvQuantity::i_d:
        case IvQuantity::i_b:
            return {-10, 10, "A", "I_D (uA)", "1uA"};
        default:
            return {-100, 100, "V", "V_G (mV)", "50mV"};
    }
}

}  // namespace

/// The value that an option gives for the present file.
std::optional<double> IvCollector::option(const std::vector<double>& values) const {
    if (values.empty()) return std::nullopt;
    return values[std::min<std::size_t>(file_, values.size() - 1)];
}

Result<void> IvCollector::check_options() const {
    struct Option {
        const std::vector<double>& values;
        std::string_view name;
        IvQuantity quantity;
    };
    const Option all[] = {{options_.width, "--width", IvQuantity::width},
                          {options_.length, "--length", IvQuantity::length},
                          {options_.temperature, "--temperature", IvQuantity::temperature},
                          {options_.v_ds, "--vds", IvQuantity::v_ds},
                          {options_.v_bs, "--vbs", IvQuantity::v_bs}};
    for (const auto& [values, name, quantity] : all) {
        if (values.size() > 1 && values.size() != files_)
            return bad_usage(
                fmt::format("{} has {} values; give one for all files, or one for each of the {} files", name, values.size(), files_));
        const auto range = range_of(quantity);
        for (const double x : values)
            if (!range.contains(x))
                return bad_usage(fmt::format("{} {:g} is {}; write a value such as {} {}", name, x, range.text(), name, range.option));
    }
    return {};
}

Result<void> IvCollector::begin_file(std::uint32_t file, std::span<const std::string> headings, SourceLocation at) {
    file_ = file;
    const auto found = find_iv_columns(headings, options_.columns);
    if (!found) return bad_input(found.error().message, std::move(at));
    columns_ = *found;
    if (column(IvQuantity::v_d) || column(IvQuantity::v_ds) || !options_.v_ds.empty()) return {};
    return bad_input(fmt::format("no column holds the drain voltage; this file has: {}. Name one with --column v_ds=HEAD, or give a "
                                 "constant with --vds 50mV",
                                 joined(headings)),
                     std::move(at));
}

Result<double> IvCollector::value(const IvRow& row, IvQuantity q, double fallback) const {
    if (!column(q)) return fallback;
    const double x = TRY(row.number(q, *column(q)));
    if (std::isnan(x) && q == IvQuantity::i_b) return x;
    const auto range = range_of(q);
    if (range.contains(x)) return x;
    return row.error_at(q, fmt::format("{} = {:g} is {}; write the unit into the heading, such as '{}'",
                                       iv_quantity_names[static_cast<std::size_t>(q)], x, range.text(), range.heading));
}

/// The voltage of a terminal, from its column, or `constant` above the source.
Result<double> IvCollector::voltage(const IvRow& row, IvQuantity absolute, IvQuantity referred, double v_s,
                                    std::optional<double> constant) const {
    if (column(referred)) return v_s + TRY(value(row, referred, 0));
    if (column(absolute)) return value(row, absolute, 0);
    return v_s + constant.value_or(0);
}

Result<void> IvCollector::add(const IvRow& row) {
    IvPoint p;
    p.file = file_;
    const double v_s = TRY(value(row, IvQuantity::v_s, 0));
    p.v[0] = TRY(voltage(row, IvQuantity::v_d, IvQuantity::v_ds, v_s, option(options_.v_ds)));
    p.v[1] = TRY(voltage(row, IvQuantity::v_g, IvQuantity::v_gs, v_s, std::nullopt));
    p.v[2] = v_s;
    p.v[3] = TRY(voltage(row, IvQuantity::v_b, IvQuantity::v_bs, v_s, option(options_.v_bs)));
    p.I_D = TRY(value(row, IvQuantity::i_d, 0)), p.I_B = TRY(value(row, IvQuantity::i_b, p.I_B));
    p.temperature = TRY(value(row, IvQuantity::temperature, option(options_.temperature).value_or(p.temperature)));
    const auto W = option(options_.width), L = option(options_.length);
    IvDevice device{std::string(row.device)};
    device.W = TRY(value(row, IvQuantity::width, W.value_or(device.W)));
    device.L = TRY(value(row, IvQuantity::length, L.value_or(device.L)));
    p.device = device_index(std::move(device));
    lacks_size_ = lacks_size_ || (!W && !column(IvQuantity::width)) || (!L && !column(IvQuantity::length));
    lacks_temperature_ = lacks_temperature_ || (options_.temperature.empty() && !column(IvQuantity::temperature));
    lacks_bulk_ = lacks_bulk_ || (!column(IvQuantity::v_b) && !column(IvQuantity::v_bs) && options_.v_bs.empty());
    if (data.points.size() >= max_points)
        return row.error_at(IvQuantity::i_d, fmt::format("there are more than {} points; give fewer rows", max_points));
    data.points.push_back(p);
    return {};
}

std::uint32_t IvCollector::device_index(IvDevice one) {
    const auto [at, is_new] = known_devices_.try_emplace({one.name, one.W, one.L}, static_cast<std::uint32_t>(data.devices.size()));
    if (is_new) data.devices.push_back(std::move(one));
    return at->second;
}

void IvCollector::note_assumptions() {
    if (lacks_bulk_) data.notes.emplace_back("no bulk voltage: the bulk is taken as connected to the source (--vbs sets another)");
    if (lacks_temperature_) data.notes.emplace_back("no temperature: 27 C is assumed (--temperature sets another)");
    data.is_geometry_known = !lacks_size_;
}

}  // namespace corpuscle
