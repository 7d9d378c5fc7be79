#include "circuit/measure/measurement_set.hpp"

#include "circuit/measure/measure_line.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

using Numbers = std::vector<std::pair<std::string, double>>;

constexpr std::size_t max_recorded = 100'000'000;  // numbers of one recording

/// The columns of a plot that a line may need: that of the swept quantity, and the curves whose name in parentheses occurs in the line.
std::vector<std::size_t> columns_for(const Directive& line, const Plot& head) {
    auto text = joined(line.words, " ");
    std::ranges::replace(text, ':', '.');
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < head.curves.size(); ++k) {
        const std::string_view name = head.curves[k].name;
        const auto open = name.find('(');
        const auto inside = open == std::string_view::npos ? name : name.substr(open + 1, name.size() - open - 2);
        if ((k == 0 && head.has_sweep) || text.find(inside) != std::string::npos) out.push_back(k);
    }
    return out;
}

}  // namespace

void MeasurementSet::Recording::add(const PlotRow& row) {
    is_too_long = is_too_long || real.size() + 2 * complex.size() > max_recorded;
    if (is_too_long) return;
    for (const auto k : columns) row.is_complex() ? complex.push_back(row[k]) : real.push_back(row.real[k]);
}

void MeasurementSet::Recording::send_to(Measurement& measurement) const {
    const auto width = columns.size();
    for (std::size_t k = 0; k < real.size(); k += width) {
        if (head.inner_points > 0 && k / width % head.inner_points == 0) measurement.begin_sweep();
        const auto row = std::span(real).subspan(k, width);
        measurement.add_point(head.has_sweep ? row[0] : 0, PlotRow(row));
    }
    for (std::size_t k = 0; k < complex.size(); k += width) {
        const auto row = std::span(complex).subspan(k, width);
        measurement.add_point(head.has_sweep ? row[0].real() : 0, PlotRow(row));
    }
}

MeasurementSet::MeasurementSet(const Circuit& circuit) : circuit_(circuit) {
    for (const auto& c : circuit.directives) {
        if (!is_measure(c)) continue;
        auto line = normalized_measure(c, circuit);
        auto& entry = entries_.emplace_back(Entry{&c, c, {}, nullptr, {}, {}});
        line ? void(entry.line = std::move(*line)) : void(entry.error = line.error());
        if (line && !foreign_measured_analysis(entry.line.words[0]).empty())
            entry.left_out = error_at(c.location, ".meas {} is left out: '{}' of another simulator is not supported", entry.line.words[1],
                                      entry.line.words[0]);
    }
}

/// The results of the lines before an entry; those that are not in `numbers` are 1.
MeasureScope MeasurementSet::scope_before(const Entry& entry, const Numbers& numbers) const {
    MeasureScope out{&circuit_, numbers};
    for (const auto& earlier : entries_) {
        if (&earlier == &entry) break;
        if (!earlier.error && std::ranges::find(numbers, earlier.line.words[1], &Numbers::value_type::first) == numbers.end())
            out.results.emplace_back(earlier.line.words[1], 1.0);
    }
    return out;
}

Result<void> MeasurementSet::begin(const Directive& analysis, const Plot& head) {
    active_.clear(), has_sweep_ = head.has_sweep, inner_points_ = head.inner_points, points_ = 0;
    for (auto& entry : entries_) {
        if (entry.error) return *entry.error;
        // A line that has begun already measured an earlier analysis of this kind.
        if (entry.line.words[0] != analysis.name || !entry.directive->applies_to(analysis)) continue;
        if (entry.has_begun || entry.left_out || is_expression_of_results(entry.line)) continue;
        entry.has_begun = true;
        auto parsed = TRY(parse_measurement(entry.line, head, scope_before(entry, {})));
        entry.left_out = std::move(parsed.left_out);
        if (entry.left_out) continue;
        active_.push_back(&entry);
        if (!parsed.uses_results) {
            entry.measurement = std::move(parsed.measurement);
            continue;
        }
        entry.recording =
            Recording{{head.name, head.is_complex, head.has_sweep, {}, head.inner_points}, columns_for(entry.line, head), {}, {}};
        for (const auto k : entry.recording->columns) entry.recording->head.curves.push_back(head.curves[k]);
    }
    return {};
}

Result<void> MeasurementSet::check(const std::vector<std::string>& number_names) {
    Numbers known;  // the values are arbitrary, since only the names matter
    for (const auto& name : number_names) known.emplace_back(name, 1.0);
    std::vector<Error> warnings;
    return finish(known, warnings, warnings);
}

Result<double> MeasurementSet::result_of(Entry& entry, const Numbers& numbers) {
    const auto& c = entry.line;
    if (is_expression_of_results(c)) return evaluate_expression_of_results(c, circuit_, numbers);
    if (!entry.has_begun) {
        entry.left_out = error_at(c.location, ".meas {} is left out: the netlist has no .{} to measure", c.words[1], c.words[0]);
        return not_found;
    }
    if (!entry.recording) return entry.measurement->value();
    if (entry.recording->is_too_long) {
        entry.left_out = error_at(
            c.location, ".meas {} is left out: it depends on an earlier measure, and the analysis has too many points", c.words[1]);
        return not_found;
    }
    auto parsed = TRY(parse_measurement(c, entry.recording->head, scope_before(entry, numbers)));
    entry.recording->send_to(*parsed.measurement);
    return parsed.measurement->value();
}

Result<void> MeasurementSet::finish(Numbers& numbers, std::vector<Error>& warnings, std::vector<Error>& left_out) {
    for (auto& entry : entries_) {
        if (entry.error) return *entry.error;
        const double value = TRY(entry.left_out ? Result<double>(not_found) : result_of(entry, numbers));
        if (entry.left_out)
            left_out.push_back(*entry.left_out);
        else if (std::isnan(value))
            warnings.push_back(error_at(entry.line.location, ".meas {}: nothing was found", entry.line.words[1]));
        numbers.emplace_back(entry.line.words[1], value);
    }
    return {};
}

}  // namespace corpuscle::circuit
