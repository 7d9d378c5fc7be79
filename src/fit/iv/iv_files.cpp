// Reads the points of I-V curves from tables and .raw files.

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"
#include "fit/iv/iv_collector.hpp"
#include "io/spice/raw_file.hpp"
#include "io/text/named_columns.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t min_points = 10;

/// The number in a field of the current line.
Result<double> number_in(const NamedColumns& table, IvQuantity q, const IvColumn& c) {
    double x = 0;
    const auto text = trimmed(table.fields()[c.index]);
    if (text.empty() && q == IvQuantity::i_b) return std::numeric_limits<double>::quiet_NaN();
    if (table.number(c.index, x)) return x * c.factor + c.offset;
    return table.error_at(fmt::format("{}: '{}' is not a number; correct it, or delete the row",
                                      iv_quantity_names[static_cast<std::size_t>(q)], text.substr(0, 40)),
                          c.index);
}

Result<void> read_text_file(IvCollector& to, std::uint32_t file, const std::string& path) {
    NamedColumns table(TRY(LineReader::open(path)));
    if (!TRY(table.read_header()))
        return bad_input("the file is empty; expected a header, such as V_G,V_D,I_D, and rows of numbers", {path});
    const std::vector<std::string> headings(table.fields().begin(), table.fields().end());
    TRY(to.begin_file(file, headings, table.error_at("").location));
    const auto before = to.data.points.size(), device = to.field_of(IvQuantity::device);
    IvRow row{[&](IvQuantity q, const IvColumn& c) { return number_in(table, q, c); },
              [&](IvQuantity q, std::string message) { return table.error_at(std::move(message), to.field_of(q)); }};
    while (TRY(table.next())) {
        if (table.fields().size() != headings.size())
            return table.error_at(fmt::format("{} fields where the header has {}", table.fields().size(), headings.size()));
        if (device != std::string::npos) row.device = trimmed(table.fields()[device]);
        TRY(to.add(row));
    }
    if (to.data.points.size() == before) return bad_input("the table has a header but no rows; add the measured points", {path});
    return {};
}

Result<void> read_raw(IvCollector& to, std::uint32_t file, const std::string& path) {
    for (const auto& plot : TRY(read_raw_file(path))) {
        TRY(to.begin_file(file, plot.variables, {path}));
        std::size_t point = 0;
        std::string device;
        IvRow row{[&](IvQuantity, const IvColumn& c) { return Result<double>(plot.values[c.index][point] * c.factor + c.offset); },
                  [&](IvQuantity, const std::string& message) {
                      return bad_input(fmt::format("plot '{}', point {}: {}", plot.name.substr(0, 60), point, message), {path});
                  }};
        for (; point < plot.points(); ++point) {
            if (const auto column = to.field_of(IvQuantity::device); column != std::string::npos)
                device = fmt::format("{:g}", plot.values[column][point]), row.device = device;
            TRY(to.add(row));
        }
    }
    return {};
}

}  // namespace

Result<IvData> read_iv_files(const std::vector<std::string>& paths, const IvOptions& options) {
    IvCollector collector(options, paths.size());
    TRY(collector.check_options());
    for (std::size_t f = 0; f < paths.size(); ++f) {
        const bool is_raw = lower(paths[f]).ends_with(".raw");
        TRY((is_raw ? read_raw : read_text_file)(collector, static_cast<std::uint32_t>(f), paths[f]));
    }
    auto& data = collector.data;
    if (data.points.size() < min_points)
        return bad_input(fmt::format("{} points are too few; a card needs at least {}, such as a sweep of V_G at two values of V_D",
                                     data.points.size(), min_points),
                         {paths[0]});
    collector.note_assumptions();
    TRY(set_polarity(data, options.is_pmos, paths[0]));
    divide_into_curves(data);
    return std::move(data);
}

}  // namespace corpuscle
