#include "cli/run/variant_printer.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unordered_set>

#include "cli/output/terminal.hpp"
#include "run/netlist/variant_run.hpp"
#include "run/summary/json_number.hpp"
#include "sweep/stats/estimate.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

/// The values of a curve; a complex value is a pair of real and imaginary part.
Json column(const Plot& plot, const Curve& curve) {
    Json out = Json::array();
    for (const auto& x : curve.values)
        out.push_back(plot.is_complex && curve.type != "frequency" ? Json({json_number(x.real()), json_number(x.imag())})
                                                                   : json_number(x.real()));
    return out;
}

Json document_of(const FourierSpectrum& spectrum) {
    Json harmonics = Json::array();
    for (const auto& h : spectrum.harmonics)
        harmonics.push_back({{"frequency", h.frequency}, {"magnitude", json_number(h.magnitude)}, {"phase", json_number(h.phase)}});
    return {{"curve", spectrum.curve},
            {"frequency", spectrum.frequency},
            {"mean", json_number(spectrum.mean)},
            {"thd", json_number(spectrum.distortion())},
            {"harmonics", harmonics}};
}

Json document_of(const std::vector<std::complex<double>>& roots) {
    Json out = Json::array();
    for (const auto& s : roots)
        out.push_back({{"real", s.real()},
                       {"imag", s.imag()},
                       {"frequency", std::abs(s) / (2 * std::numbers::pi)},
                       {"q", s.imag() == 0 ? Json() : json_number(quality_of(s))}});
    return out;
}

/// Looking up a key of an ordered object takes time in proportion to its size, so it is done for repeated names only.
Json curves_of(const Plot& plot) {
    Json out = Json::object();
    auto& curves = out.get_ref<Json::object_t&>();
    std::unordered_set<std::string_view> names;
    for (const auto& curve : plot.curves)
        if (names.insert(curve.name).second)
            curves.push_back({curve.name, column(plot, curve)});
        else
            curves[curve.name] = column(plot, curve);
    return out;
}

Json document_of(const VariantResult& result) {
    const auto& outcome = result.outcome;
    Json plots = Json::array(), analyses = Json::array(), numbers = Json::object(), expectations = Json::array(), warnings = Json::array();
    for (const auto& plot : result.plots) {
        plots.push_back({{"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves_of(plot)}});
    }
    for (const auto& a : outcome.analyses) {
        Json one = {{"analysis", a.directive->name}, {"points", a.point_count}};
        for (const auto& [quantity, count] : a.result.stats) one[quantity] = static_cast<std::int64_t>(count);
        if (a.result.poles) one["poles"] = document_of(*a.result.poles);
        if (a.result.zeros) one["zeros"] = document_of(*a.result.zeros);
        for (const auto& spectrum : a.spectra) one["fourier"].push_back(document_of(spectrum));
        analyses.push_back(one);
    }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = json_number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back(
            {{"name", e.name}, {"actual", json_number(e.actual)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"met", e.is_met}});
    for (const auto& r : outcome.warnings) warnings.push_back(r.text());
    Json out = {{"title", result.variant.circuit->title}, {"plots", plots},      {"analyses", analyses}, {"numbers", numbers},
                {"expectations", expectations},           {"warnings", warnings}};
    for (const auto& a : outcome.analyses)
        if (a.result.spikes) out["spikes"].push_back(*a.result.spikes);  // one list per .tran
    if (result.cost) out["budget"] = circuit::document_of(*result.cost);
    return out;
}

/// Prints the measurements and the expectations, in SI units.
void print_numbers(const RunOutcome& outcome) {
    for (const auto& [name, value] : outcome.numbers)
        std::isnan(value) ? fmt::print("{:20} = failed\n", printable(name)) : fmt::print("{:20} = {:.6e}\n", printable(name), value);
    for (const auto& e : outcome.expectations)
        fmt::print("{:20} = {:.6e}, expected {:g} within {:g}: {}\n", printable(e.name), e.actual, e.expected, e.tolerance,
                   e.is_met ? "holds" : "does not hold");
}

/// Prints all results of the only variant.
void print(const VariantResult& result) {
    for (const auto& a : result.outcome.analyses) {
        fmt::print("{}.{}: {} point{}\n", &a == &result.outcome.analyses[0] ? "" : "\n", a.directive->name, a.point_count,
                   a.point_count == 1 ? "" : "s");
        print_text(a.result.table + a.printed_tables);
        for (const auto& spectrum : a.spectra) print_text("\n" + spectrum.text());
    }
    if (!result.outcome.numbers.empty() || !result.outcome.expectations.empty()) fmt::print("\n");
    print_numbers(result.outcome);
    if (result.cost) print_text("\n" + budget_tables(*result.cost));
}

/// Prints the numbers of one of several variants in one line, and its .print tables.
void print_line(const VariantResult& result) {
    fmt::print("{}:", printable(result.variant.label));
    for (const auto& [name, value] : result.outcome.numbers) fmt::print("  {} = {:.6e}", printable(name), value);
    fmt::print("{}\n", result.cost ? budget_line(*result.cost) : "");
    for (const auto& a : result.outcome.analyses) print_text(a.printed_tables);
}

}  // namespace

void VariantPrinter::add(const VariantResult& result) {
    const auto& [label, outcome] = std::tie(result.variant.label, result.outcome);
    for (const auto& r : outcome.warnings) print_warning(r.text());
    if (const auto met = check_expectations_met(outcome, label); !met && !failed_expectation) failed_expectation = met.error();
    for (const auto& [name, value] : outcome.numbers) {
        if (!is_monte_carlo_) break;
        auto at = std::find_if(measured_.begin(), measured_.end(), [&](const auto& m) { return m.first == name; });
        if (at == measured_.end()) at = measured_.insert(at, {name, {}});
        if (std::isfinite(value)) at->second.push_back(value);
    }
    if (common_.json) {
        auto document = document_of(result);
        if (has_steps_) document["step"] = label;
        print_document(document);
    } else if (!common_.quiet) {
        has_steps_ ? print_line(result) : print(result);
    }
}

void VariantPrinter::fail(const std::string& label, const Error& error) {
    failures.push_back(error);
    if (common_.json)
        print_document({{"step", label}, {"error", error.message}});
    else if (!common_.quiet)
        print_text(fmt::format("{}:  {}\n", printable(label), printable(error.message)));
}

void VariantPrinter::finish() {
    if (common_.json && has_steps_) fmt::print("{}]\n", count_ == 0 ? "[" : "\n");
    if (!common_.json && !common_.quiet) print_statistics();
}

void VariantPrinter::print_document(const Json& document) {
    fmt::print("{}{}{}", !has_steps_ ? "" : count_ == 0 ? "[\n" : ",\n", json_text(document), has_steps_ ? "" : "\n");
    ++count_;
}

/// A measurement that failed in all chips has the statistics 0.
void VariantPrinter::print_statistics() const {
    for (const auto& [name, values] : measured_) {
        const SortedSample sample(values.empty() ? std::vector{0.0} : values);
        const double min = sample.values().front(), max = sample.values().back(), mean = sample.mean().value;
        const double sigma = min == max ? 0 : sample.sigma().value;  // not the rounding error of the mean of equal values
        fmt::print("{:20} mean {:.6e}  sigma {:.3e} ({:.3g} %)  range {:.6e} to {:.6e}  n = {}\n", name, mean, sigma,
                   mean == 0 ? 0 : 100 * sigma / std::abs(mean), min, max, values.size());
    }
}

}  // namespace corpuscle
