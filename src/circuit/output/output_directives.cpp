#include "circuit/output/output_directives.hpp"

#include "circuit/analyses.hpp"
#include "circuit/measure/fourier.hpp"
#include "circuit/measure/measure_line.hpp"
#include "circuit/measure/measurement_set.hpp"

namespace corpuscle::circuit {
namespace {

/// The directive of an analysis, and the curves that it will produce, without values.
struct Head {
    const Directive* directive;
    const Analysis* analysis;
    Plot plot;
};

/// True for words of .print that stand for several curves: all, and Xyce's v(*) and i(*).
bool selects_curves(std::string_view word) { return word == "all" || word == "v(*)" || word == "i(*)"; }
bool is_selected(std::string_view curve, std::string_view word) { return word == "all" || curve.starts_with(word.substr(0, 2)); }

/// True for format=csv and similar words of .print.
bool is_setting(std::string_view word) {
    const auto equals = word.find('=');
    return equals != std::string_view::npos && word.substr(0, equals).find_first_of("({'") == std::string_view::npos;
}

class OutputDirectives {
    const Circuit& circuit_;
    std::vector<Head> heads_;  // of all analyses
    // For each head, the index of its curves. It refers to the names in the head, so `heads_` must not change after the constructor.
    std::vector<CurveIndex> indices_;
    std::vector<Error>& warnings_;

public:
    OutputDirectives(const System& system, DeviceCurrents currents, std::vector<Error>& warnings)
        : circuit_(system.circuit()), warnings_(warnings) {
        for (const auto& c : circuit_.directives)
            if (const auto* analysis = find_analysis(c.name); analysis != nullptr) {
                heads_.push_back({&c, analysis, analysis->expected_plot(system, c)});
                currents.begin(heads_.back().plot);
            }
        for (const auto& head : heads_) indices_.emplace_back(head.plot);
    }

    Result<void> check() {
        if (heads_.empty()) return {};  // the run reports that there is no analysis
        for (const auto& c : circuit_.directives)
            if (c.name == "print" || c.name == "plot") {
                TRY(check_columns(c));
            } else if (c.name == "probe") {
                for (std::size_t k = 0; k < c.words.size(); ++k)
                    if (is_unsupported_probe(circuit_, c, c.words[k]))
                        warnings_.push_back(error_at(c.location_of(k), ".probe: '{}' is not supported and is ignored", c.words[k]));
            }
        MeasurementSet measures(circuit_);
        for (const auto& head : heads_) TRY(measures.begin(*head.directive, head.plot));
        const auto known = number_names();
        TRY(check_spectra());
        TRY(measures.check(known));
        for (const auto& c : circuit_.directives_named("expect")) TRY(check_expectation(c, known));
        return {};
    }

private:
    Result<void> check_spectra() {
        std::vector<Error> left_out;  // reported by the run
        for (const auto& head : heads_)
            if (head.analysis == &tran_analysis) TRY(FourierTransforms(circuit_).begin(*head.directive, head.plot, left_out));
        if (std::ranges::find(heads_, &tran_analysis, &Head::analysis) != heads_.end()) return {};
        for (const auto& c : circuit_.directives_named("four")) return error_at(c.location, ".four: the netlist has no .tran");
        return {};
    }

    /// The first word of .print and .plot may name an analysis. Each further word must be a curve of this analysis. If the first word does
    /// not name one, each word must be a curve of some analysis.
    Result<void> check_columns(const Directive& c) {
        if (c.name == "plot")
            warnings_.push_back(
                error_at(c.location, ".plot has no effect here; --out x.csv or x.raw writes the curves, .print prints columns"));
        const bool names_analysis = !c.words.empty() && find_analysis(c.words[0]) != nullptr;
        if (c.words.size() == (names_analysis ? 1U : 0U)) return error_at(c.location, ".{}: expected .{} tran v(NODE) ...", c.name, c.name);
        if (names_analysis && std::none_of(heads_.begin(), heads_.end(), [&](const Head& h) { return h.directive->name == c.words[0]; })) {
            warnings_.push_back(error_at(c.location, ".{}: the netlist has no .{}, so nothing is printed", c.name, c.words[0]));
            return {};
        }
        for (std::size_t k = names_analysis ? 1 : 0; k < c.words.size(); ++k)
            if (is_setting(c.words[k]))
                warnings_.push_back(error_at(c.location_of(k), ".{}: '{}' has no effect here", c.name, c.words[k]));
            else if (selects_curves(c.words[k]))
                continue;
            else if (const auto ok = check_curve(c, k, names_analysis); !ok)
                warnings_.push_back(ok.error());
        return {};
    }
    /// Checks that word k is a curve. If `names_analysis` is true, only the analysis that the first word names may have it.
    Result<void> check_curve(const Directive& c, std::size_t k, bool names_analysis) const {
        const auto& word = c.words[k];
        for (std::size_t h = 0; h < heads_.size(); ++h)
            if ((!names_analysis || heads_[h].directive->name == c.words[0]) && CurveView::find(heads_[h].plot, word, &indices_[h]))
                return {};
        std::vector<std::string_view> known;
        for (const auto& head : heads_)
            if (!names_analysis || head.directive->name == c.words[0])
                for (const auto& curve : head.plot.curves) known.push_back(curve.name);
        if (const auto text = curve_expression_text(word))
            if (const auto expression = Expression::parse(*text, c.location, curve_scope()); !expression)
                return error_at(c.location_of(k), "{}", expression.error().message);
        const bool is_axis_limit = c.name == "plot" && word.starts_with("(");  // (0,5)
        if (is_axis_limit) return {};
        const bool is_device_current =
            word.starts_with("i(") && circuit_.find_element(word.size() > 3 ? word.substr(2, word.size() - 3) : "") >= 0;
        const auto hint = is_device_current ? "; put a 0 V source in series to measure its current" : did_you_mean(word, known);
        return error_at(c.location_of(k), ".{}: there is no curve '{}', so the column is left out{}", c.name, word, hint);
    }

    /// Returns an error if the name in an .expect is neither a measurement, a number of an analysis nor a curve.
    Result<void> check_expectation(const Directive& c, const std::vector<std::string>& analysis_numbers) const {
        if (c.words.empty()) return {};  // run_directives() reports the syntax
        const auto name = c.words[0].substr(0, c.words.size() == 2 ? c.words[0].find('=') : std::string::npos);
        std::vector<Directive> measures;
        for (const auto& other : circuit_.directives)
            if (is_measure(other)) measures.push_back(TRY(normalized_measure(other, circuit_)));
        std::vector<std::string_view> known(analysis_numbers.begin(), analysis_numbers.end());
        for (const auto& measure : measures) known.push_back(measure.words[1]);
        if (std::find(known.begin(), known.end(), name) != known.end()) return {};
        for (std::size_t h = 0; h < heads_.size(); ++h)
            if (CurveView::find(heads_[h].plot, name, &indices_[h])) return {};
        return error_at(c.location, ".expect: there is no measurement, number or curve '{}'{}", name, did_you_mean(name, known));
    }

    /// Names of the numbers that the analyses may produce.
    std::vector<std::string> number_names() const {
        std::vector<std::string> out;
        for (const auto& head : heads_) {
            out.insert(out.end(), head.analysis->numbers.begin(), head.analysis->numbers.end());
            if (head.analysis->has_number_for_each_curve)
                for (const auto& curve : head.plot.curves) out.push_back(curve.name);
        }
        for (const auto& c : circuit_.directives_named("four"))
            for (std::size_t k = 1; k < c.words.size(); ++k) out.push_back(FourierSpectrum{c.words[k], 0, 0, {}}.distortion_name());
        return out;
    }
};

constexpr double max_rows = 1e6;  // of one table of a .tran

/// The table of a directive with its heads; the swept quantity is the first column. Without columns if it is not a .print line, names
/// another analysis, or names no curve of the plot.
PrintedTable table_of(const Directive& c, const Directive& analysis, const Plot& plot) {
    PrintedTable out;
    const auto add = [&](const std::string& name) {
        const auto view = CurveView::find(plot, name);
        if (!view) return;
        out.views.push_back(*view);
        out.text += fmt::format("{:>16}", name);
    };
    const bool names_analysis = !c.words.empty() && find_analysis(c.words[0]) != nullptr;
    if (c.name != "print" || (names_analysis && c.words[0] != analysis.name) || !c.applies_to(analysis)) return out;
    if (plot.has_sweep) add(plot.curves[0].name);
    for (std::size_t w = names_analysis ? 1 : 0; w < c.words.size(); ++w)
        if (selects_curves(c.words[w])) {
            for (std::size_t k = plot.has_sweep; k < plot.curves.size(); ++k)
                if (is_selected(plot.curves[k].name, c.words[w])) add(plot.curves[k].name);
        } else {
            add(c.words[w]);
        }
    if (out.views.size() < (plot.has_sweep ? 2U : 1U)) return {};
    out.text += '\n';
    return out;
}

void append_number(std::string& out, std::complex<double> x) {
    const auto to = std::back_inserter(out);
    x.imag() == 0 ? fmt::format_to(to, "{:16.7e}", x.real()) : fmt::format_to(to, " {:.7e},{:.7e}", x.real(), x.imag());
}

}  // namespace

Result<void> check_output_directives(const System& system, DeviceCurrents currents, std::vector<Error>& warnings) {
    return OutputDirectives(system, std::move(currents), warnings).check();
}

Result<void> TablePrinter::begin(const Plot& plot) {
    for (const auto& c : circuit_.directives) {
        auto table = table_of(c, analysis_, plot);
        if (table.views.empty()) continue;
        if (const double rows = std::floor((times_.stop - times_.start) / times_.step) + 1; times_.step > 0 && rows > max_rows)
            return error_at(
                c.location,
                ".print tran: {:g} rows (one every {:g} s over {:g} s) exceed the limit of {:g}; use a longer STEP of .tran, or --out",
                rows, times_.step, times_.stop - times_.start, max_rows);
        tables_.push_back(std::move(table));
    }
    return {};
}

/// Appends a row to each table, at a time between the previous point and the point `row`.
void TablePrinter::print_at_next_time(std::span<const double> row) {
    const double t = next_time();
    for (auto& table : tables_) {
        for (const auto& view : table.views) {
            const double before = view.value(PlotRow(previous_)).real(), now = view.value(PlotRow(row)).real();
            const bool is_time = &view == &table.views[0];
            append_number(table.text, is_time ? t : LineSegment{previous_[0], before, row[0], now}.at(t));
        }
        table.text += '\n';
    }
    ++rows_;
}

Result<void> TablePrinter::add_point(const PlotRow& row) {
    if (times_.step == 0) {
        for (auto& table : tables_) {
            for (const auto& view : table.views) append_number(table.text, view.value(row));
            table.text += '\n';
        }
        return {};
    }
    if (tables_.empty()) return {};
    const double t = row.real[0];
    if (previous_.empty()) {
        previous_.assign(row.real.begin(), row.real.end());
        // Skips rows before the first point. The tolerance keeps a row that is at this point up to rounding.
        while (next_time() <= t - 1e-9 * times_.step) ++rows_;
    }
    while (next_time() <= t) print_at_next_time(row.real);
    previous_.assign(row.real.begin(), row.real.end());
    return {};
}

/// The time of the last row may exceed the end of the analysis by a rounding error.
Result<void> TablePrinter::end() {
    if (!previous_.empty() && next_time() <= previous_[0] + 1e-9 * times_.step) print_at_next_time(std::vector(previous_));
    return {};
}

std::string TablePrinter::text() const {
    std::string out;
    for (const auto& table : tables_) out += table.text;
    return out;
}

}  // namespace corpuscle::circuit
