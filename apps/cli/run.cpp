// corpuscle run: the analyses written in a netlist.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "circuit/raw.hpp"
#include "circuit/run.hpp"
#include "circuit/variants.hpp"
#include "io/output.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json column(const Plot& plot, const Curve& curve) {
    Json out = Json::array();
    for (const auto& x : curve.values)
        out.push_back(plot.is_complex && curve.type != "frequency" ? Json({number(x.real()), number(x.imag())}) : number(x.real()));
    return out;
}

Json document_of(const Circuit& c, const RunOutcome& outcome) {
    Json plots = Json::array(), numbers = Json::object(), expectations = Json::array(), remarks = Json::array();
    for (const auto& plot : outcome.plots()) {
        Json curves = Json::object();
        for (const auto& curve : plot.curves) curves[curve.name] = column(plot, curve);
        plots.push_back({{"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves}});
    }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back(
            {{"what", e.what}, {"found", number(e.found)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"holds", e.held}});
    for (const auto& r : outcome.remarks) remarks.push_back(r.text());
    Json out = {{"title", c.title}, {"plots", plots}, {"numbers", numbers}, {"expectations", expectations}, {"warnings", remarks}};
    for (const auto& a : outcome.analyses)
        if (a.findings.spikes) out["spikes"].push_back(*a.findings.spikes);  // a list each .tran
    return out;
}

/// One of the circuits that a netlist asks for, and what was found.
struct Done {
    Variant variant;
    RunOutcome outcome;
};

/// Where plots go as they come: a .raw file of all, or a table for each analysis, x.csv or x-1.csv, x-2.csv ..., whose rows begin with
/// the step they belong to, if there are several.
class PlotFiles {
    const RunWords& words_;
    bool several_;
    std::vector<OutputFile> files_;

public:
    PlotFiles(const RunWords& words, bool several) : words_(words), several_(several) {}

    Result<void> add(const Done& done) {
        if (words_.out.empty()) return {};
        auto plots = done.outcome.plots();
        if (words_.out.ends_with(".csv")) return tables(plots, done.variant.label);
        for (auto& plot : plots)
            if (!done.variant.label.empty()) plot.name += fmt::format(" ({})", done.variant.label);
        if (auto ok = open(1, 0, {}); !ok) return ok;
        return files_[0].write(raw_text(done.variant.circuit->title, plots, !words_.ascii));
    }
    Result<void> finish() {
        for (auto& file : files_)
            if (auto ok = file.commit(); !ok) return ok;
        return {};
    }

private:
    Result<void> tables(std::span<const Plot> plots, const std::string& label) {
        for (std::size_t k = 0; k < plots.size(); ++k) {
            if (auto ok = open(plots.size(), k, (several_ ? "step," : "") + csv_header(plots[k])); !ok) return ok;
            if (auto ok = files_[k].write(csv_rows(plots[k], several_ ? label + "," : "")); !ok) return ok;
        }
        return {};
    }
    /// File k of `count`, made at its first use with `head` in it.
    Result<void> open(std::size_t count, std::size_t k, const std::string& head) {
        if (k < files_.size()) return {};
        auto path = words_.out;
        if (count > 1) path.insert(path.size() - 4, fmt::format("-{}", k + 1));
        auto file = OutputFile::create(path);
        if (!file) return file.error();
        files_.push_back(std::move(*file));
        return files_.back().write(head);
    }
};

void print_numbers(const RunOutcome& outcome) {
    for (const auto& [name, value] : outcome.numbers)
        std::isnan(value) ? fmt::print("{:20} = failed\n", name) : fmt::print("{:20} = {:.6e}\n", name, value);
    for (const auto& e : outcome.expectations)
        fmt::print("{:20} = {:.6e}, expected {:g} within {:g}: {}\n", e.what, e.found, e.expected, e.tolerance,
                   e.held ? "holds" : "does not hold");
}

void print(const Done& done) {
    for (const auto& a : done.outcome.analyses) {
        const std::size_t points = a.findings.plots.empty() ? 0 : a.findings.plots[0].points();
        fmt::print("{}.{}: {} point{}\n", &a == &done.outcome.analyses[0] ? "" : "\n", a.command->name, points, points == 1 ? "" : "s");
        fmt::print("{}{}", a.findings.table, printed(*done.variant.circuit, a));
    }
    if (!done.outcome.numbers.empty() || !done.outcome.expectations.empty()) fmt::print("\n");
    print_numbers(done.outcome);
}

/// Of many: a line each, its measures.
void print_line(const Done& done) {
    fmt::print("{}:", done.variant.label);
    for (const auto& [name, value] : done.outcome.numbers) fmt::print("  {} = {:.6e}", name, value);
    fmt::print("\n");
    for (const auto& a : done.outcome.analyses) fmt::print("{}", printed(*done.variant.circuit, a));
}

/// How a number is spread over the chips of a .mc.
struct Spread {
    std::string name;
    std::size_t count = 0;
    double mean = 0, squares = 0, least = 0, most = 0;  // squares: summed distances from the mean (Welford)
    void add(double x) {
        least = count == 0 ? x : std::min(least, x), most = count == 0 ? x : std::max(most, x);
        const double off = x - mean;
        mean += off / static_cast<double>(++count);
        squares += off * (x - mean);
    }
    double deviation() const { return count < 2 ? 0 : std::sqrt(squares / static_cast<double>(count - 1)); }
};

/// Prints each variant as it comes, and what is left to say at the end.
class Report {
    const Common& common_;
    bool several_, draws_;
    std::size_t count_ = 0;
    std::vector<Spread> spreads_;

public:
    std::vector<Error> failures;  ///< of variants that did not converge
    std::optional<Error> broken;  ///< the first expectation that did not hold

    Report(const Common& common, bool several, bool draws) : common_(common), several_(several), draws_(draws) {}

    void add(const Done& done) {
        for (const auto& r : done.outcome.remarks) fmt::print(stderr, "corpuscle: warning: {}\n", r.text());
        for (const auto& e : done.outcome.expectations)
            if (!e.held && !broken)
                broken =
                    bad_input(fmt::format("{}{} is {:g}, not {:g} within {:g}", done.variant.label.empty() ? "" : done.variant.label + ": ",
                                          e.what, e.found, e.expected, e.tolerance),
                              e.place);
        spread(done.outcome.numbers);
        if (common_.json) {
            auto document = document_of(*done.variant.circuit, done.outcome);
            if (several_) document["step"] = done.variant.label;
            put(document);
        } else if (!common_.quiet) {
            several_ ? print_line(done) : print(done);
        }
    }
    void fail(const std::string& label, const Error& error) {
        failures.push_back(error);
        if (common_.json)
            put({{"step", label}, {"error", error.sentence}});
        else if (!common_.quiet)
            fmt::print("{}:  {}\n", label, error.sentence);
    }
    void finish() {
        if (common_.json) return several_ ? fmt::print("{}]\n", count_ == 0 ? "[" : "\n") : void();
        if (common_.quiet) return;
        for (const auto& s : spreads_)
            fmt::print("{:20} mean {:.6e}  deviation {:.3e} ({:.3g} %)  from {:.6e} to {:.6e}  of {}\n", s.name, s.mean, s.deviation(),
                       s.mean == 0 ? 0 : 100 * s.deviation() / std::abs(s.mean), s.least, s.most, s.count);
    }

private:
    void put(const Json& document) {
        fmt::print("{}{}{}", !several_ ? "" : count_ == 0 ? "[\n" : ",\n", document.dump(1), several_ ? "" : "\n");
        ++count_;
    }
    void spread(const std::vector<std::pair<std::string, double>>& numbers) {
        if (!draws_) return;
        for (const auto& [name, value] : numbers) {
            auto at = std::find_if(spreads_.begin(), spreads_.end(), [&](const Spread& s) { return s.name == name; });
            if (at == spreads_.end()) at = spreads_.insert(at, {name});
            if (std::isfinite(value)) at->add(value);
        }
    }
};

Result<void> run_all(Variants& variants, const Common& common, Report& report, PlotFiles& files) {
    const auto count = variants.count();
    Progress progress(common.quiet);
    std::unique_ptr<TestBench> bench;
    for (std::size_t k = 0; k < count; ++k) {
        auto variant = variants.at(k);
        if (!variant) return variant.error();
        if (!bench || bench->circuit != variant->circuit) {
            auto made = TestBench::make(variant->circuit);
            if (!made) return made.error();
            bench = std::move(*made);
        }
        bench->brief = k > 0 || variant->draw;
        if (variant->draw) bench->draw(*variant->draw);
        auto found = circuit::run(*bench, [&](std::string_view, double share) {
            progress.at((static_cast<double>(k) + share) / static_cast<double>(count));
            return interrupted();
        });
        if (interrupted()) return Error{Code::interrupted, "interrupted"};
        progress.at(static_cast<double>(k + 1) / static_cast<double>(count));
        if (!found && found.error().code == Code::not_converged && count > 1) {
            report.fail(variant->label, found.error());
            continue;
        }
        if (!found) {
            auto error = found.error();
            if (!variant->label.empty()) error.sentence = fmt::format("{}: {}", variant->label, error.sentence);
            return error;
        }
        const Done done{std::move(*variant), std::move(*found)};
        report.add(done);
        if (auto ok = files.add(done); !ok) return ok;
    }
    return {};
}

Result<void> run_netlist(const RunWords& words, const Common& common) {
    const auto netlist = Netlist::read(words.netlist);
    if (!netlist) return netlist.error();
    auto variants = Variants::of(*netlist);
    if (!variants) return variants.error();
    const bool several = variants->count() > 1;
    Report report(common, several, variants->draws());
    PlotFiles files(words, several);
    const auto done = run_all(*variants, common, report, files);
    report.finish();
    if (!done) return done;
    if (auto ok = files.finish(); !ok) return ok;
    if (!report.failures.empty()) {
        auto error = report.failures[0];
        error.sentence = fmt::format("{} of {} did not converge; the first: {}", report.failures.size(), variants->count(), error.sentence);
        return error;
    }
    if (report.broken) return *report.broken;
    return {};
}

}  // namespace

int run(const RunWords& words, const Common& common) {
    catch_interrupt();
    const auto done = run_netlist(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
