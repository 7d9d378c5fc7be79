#include "circuit/measure/measurement.hpp"

namespace corpuscle::circuit {
namespace {

bool is_expression(const Directive& c) { return c.words.size() > 2 && c.words[2].starts_with("param="); }

using KnownNumbers = std::vector<std::pair<std::string, double>>;

/// Parses param='EXPRESSION', which may use numbers of the analyses and results of earlier measurements.
Result<Expression> parse_expression(const Directive& c, const KnownNumbers& numbers) {
    ExpressionScope scope;
    scope.parameter = [&](std::string_view name) -> std::optional<double> {
        for (const auto& [known, value] : numbers)
            if (known == name) return value;
        return {};
    };
    for (const auto& [known, value] : numbers) scope.suggestions.push_back(known);
    auto inside = c.words[2].substr(6);  // after "param="
    if (inside.size() > 1 && (inside.front() == '\'' || inside.front() == '{')) inside = inside.substr(1, inside.size() - 2);
    return Expression::parse(inside, c.location, scope);
}

Error without_analysis(const Directive& c) { return error_at(c.location, ".meas: the netlist has no .{} to measure", c.words[0]); }
Error incomplete_measure(const Directive& c) {
    return error_at(c.location, ".meas: expected .meas op|dc|ac|noise|tran NAME MEASUREMENT ...");
}

}  // namespace

bool CrossingCounter::add_point(double x, const PlotRow& row) {
    if (!follower.add_point(x, row)) return false;
    const auto& segment = *follower.segment;
    if (!(segment.rises() && edges.rising) && !(segment.falls() && edges.falling)) return false;
    const double zero = segment.zero();
    if (!edges.interval.contains(zero)) return false;
    ++count;
    if (edges.number != 0 && count != edges.number) return false;
    position = zero;
    return true;
}

void ValueMeasurement::add_point(double x, const PlotRow& row) {
    const bool has_segment = curve_.add_point(x, row), is_crossing = event_.add_point(x, row);
    if (!has_segment) return;
    const auto& segment = *curve_.segment;
    if (!first_segment_) first_segment_ = segment;
    // With at=X, the first segment that contains X counts.
    const bool is_here = event_.crossing ? is_crossing : std::isnan(value_) && segment.contains(event_.at);
    if (is_here) value_ = value_in(segment, event_.position());
}

/// at=X that lies beyond an end of the curve only by rounding counts as that end.
double ValueMeasurement::value() const {
    if (!std::isnan(value_) || event_.crossing || !curve_.segment) return value_;
    const auto& last = *curve_.segment;
    const auto& first = first_segment_ ? *first_segment_ : last;
    const double tolerance = 1e-9 * std::abs(last.x1 - first.x0);
    if (std::abs(event_.at - last.x1) <= tolerance) return value_in(last, last.x1);
    if (std::abs(event_.at - first.x0) <= tolerance) return value_in(first, first.x0);
    return not_found;
}

void CurveSummary::add_extreme(double x, double y) {
    if (!any || y < low) low = y, low_at = x;
    if (!any || y > high) high = y, high_at = x;
    any = true;
}

void CurveSummary::add(const LineSegment& segment) {
    if (!any) first_value = segment.y0;
    add_extreme(segment.x0, segment.y0);
    add_extreme(segment.x1, segment.y1);
    const double over_x = segment.integral();
    length += segment.length(), integral += over_x, area += segment.x1 < segment.x0 ? -over_x : over_x;
    squares += segment.integral_of_square();
}

void SummaryMeasurement::add_point(double x, const PlotRow& row) {
    curve_.add_point(x, row);
    auto segment = *curve_.segment;  // at the first point a segment of length 0
    if (segment.cut(interval_.from, interval_.to)) summary_.add(segment);
}

MeasurementSet::MeasurementSet(const Circuit& circuit) {
    for (const auto& c : circuit.directives)
        if (c.name == "meas" || c.name == "measure") entries_.push_back({&c, nullptr});
}

Result<void> MeasurementSet::begin(std::string_view analysis, const Plot& head) {
    active_.clear(), has_sweep_ = head.has_sweep, inner_points_ = head.inner_points, points_ = 0;
    for (auto& entry : entries_) {
        // A line that has a measurement already measured an earlier analysis of this kind.
        const auto& c = *entry.directive;
        if (c.words.size() < 3 || c.words[0] != analysis || is_expression(c) || entry.measurement) continue;
        entry.measurement = TRY(parse_measurement(c, head));
        active_.push_back(entry.measurement.get());
    }
    return {};
}

Result<void> MeasurementSet::check(const std::vector<std::string>& number_names) const {
    KnownNumbers known;  // the values are arbitrary, since only the names matter
    for (const auto& name : number_names) known.emplace_back(name, 1.0);
    std::vector<Error> warnings;
    return finish(known, warnings);
}

Result<void> MeasurementSet::finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings) const {
    for (const auto& [directive, measurement] : entries_) {
        const auto& c = *directive;
        if (c.words.size() < 3) return incomplete_measure(c);
        if (is_expression(c)) {
            const auto expression = TRY(parse_expression(c, numbers));
            numbers.emplace_back(c.words[1], expression.value());
            continue;
        }
        if (!measurement) return without_analysis(c);
        const double value = measurement->value();
        if (std::isnan(value)) warnings.push_back(error_at(c.location, ".meas {}: nothing was found", c.words[1]));
        numbers.emplace_back(c.words[1], value);
    }
    return {};
}

}  // namespace corpuscle::circuit
