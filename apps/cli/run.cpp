// corpuscle run: the analyses written in a netlist.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "budget_words.hpp"
#include "circuit/analyses.hpp"
#include "circuit/cost/accountant.hpp"
#include "circuit/run.hpp"
#include "circuit/traced.hpp"
#include "circuit/variants.hpp"
#include "curve_files.hpp"
#include "netlist_words.hpp"
#include "printable.hpp"
#include "study/cost_document.hpp"
#include "study/json_number.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

Json column(const Plot& plot, const Curve& curve) {
    Json out = Json::array();
    for (const auto& x : curve.values)
        out.push_back(plot.is_complex && curve.type != "frequency" ? Json({json_number(x.real()), json_number(x.imag())})
                                                                   : json_number(x.real()));
    return out;
}

/// What is saved, for the document; where a file takes it, nothing is held.
class Gathered final : public CurveSink {
    KeptPlot kept_;

public:
    std::vector<Plot> plots;
    Result<void> whole(std::span<const Plot> more) override { return plots.insert(plots.end(), more.begin(), more.end()), Result<void>(); }
    Result<void> begin(const Plot& head) override { return kept_.begin(head); }
    Result<void> point(std::span<const double> row) override { return kept_.point(row); }
    Result<void> end() override { return plots.push_back(std::move(kept_.plot)), Result<void>(); }
};

/// One of the circuits that a netlist asks for, and what was found.
struct Done {
    Variant variant;
    RunOutcome outcome;
    std::vector<Plot> plots;  ///< for the document: all that is saved, or but for what went into a file point by point
    std::optional<Cost> cost = {};
};

Json document_of(const Done& done) {
    const auto& outcome = done.outcome;
    Json plots = Json::array(), analyses = Json::array(), numbers = Json::object(), expectations = Json::array(), remarks = Json::array();
    for (const auto& plot : done.plots) {
        Json curves = Json::object();
        for (const auto& curve : plot.curves) curves[curve.name] = column(plot, curve);
        plots.push_back({{"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves}});
    }
    for (const auto& a : outcome.analyses) {
        Json one = {{"analysis", a.command->name}, {"points", a.points}};
        for (const auto& [what, count] : a.findings.work) one[what] = static_cast<std::int64_t>(count);
        analyses.push_back(one);
    }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = json_number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back(
            {{"what", e.what}, {"found", json_number(e.found)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"holds", e.held}});
    for (const auto& r : outcome.remarks) remarks.push_back(r.text());
    Json out = {{"title", done.variant.circuit->title}, {"plots", plots},     {"analyses", analyses}, {"numbers", numbers},
                {"expectations", expectations},         {"warnings", remarks}};
    for (const auto& a : outcome.analyses)
        if (a.findings.spikes) out["spikes"].push_back(*a.findings.spikes);  // a list each .tran
    if (done.cost) out["budget"] = corpuscle::document_of(*done.cost);
    return out;
}

void print_numbers(const RunOutcome& outcome) {
    for (const auto& [name, value] : outcome.numbers)
        std::isnan(value) ? fmt::print("{:20} = failed\n", printable(name)) : fmt::print("{:20} = {:.6e}\n", printable(name), value);
    for (const auto& e : outcome.expectations)
        fmt::print("{:20} = {:.6e}, expected {:g} within {:g}: {}\n", printable(e.what), e.found, e.expected, e.tolerance,
                   e.held ? "holds" : "does not hold");
}

void print(const Done& done) {
    for (const auto& a : done.outcome.analyses) {
        fmt::print("{}.{}: {} point{}\n", &a == &done.outcome.analyses[0] ? "" : "\n", a.command->name, a.points, a.points == 1 ? "" : "s");
        show(a.findings.table + a.printed);
    }
    if (!done.outcome.numbers.empty() || !done.outcome.expectations.empty()) fmt::print("\n");
    print_numbers(done.outcome);
    if (done.cost) show("\n" + budget_text(*done.cost));
}

/// Of many: a line each, its measures.
void print_line(const Done& done) {
    fmt::print("{}:", printable(done.variant.label));
    for (const auto& [name, value] : done.outcome.numbers) fmt::print("  {} = {:.6e}", printable(name), value);
    fmt::print("{}\n", done.cost ? budget_line(*done.cost) : "");
    for (const auto& a : done.outcome.analyses) show(a.printed);
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
        for (const auto& r : done.outcome.remarks) tell_warning(r.text());
        for (const auto& e : done.outcome.expectations)
            if (!e.held && !broken)
                broken =
                    bad_input(fmt::format("{}{} is {:g}, not {:g} within {:g}", done.variant.label.empty() ? "" : done.variant.label + ": ",
                                          e.what, e.found, e.expected, e.tolerance),
                              e.place);
        spread(done.outcome.numbers);
        if (common_.json) {
            auto document = document_of(done);
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
            show(fmt::format("{}:  {}\n", printable(label), printable(error.sentence)));
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
        fmt::print("{}{}{}", !several_ ? "" : count_ == 0 ? "[\n" : ",\n", json_text(document), several_ ? "" : "\n");
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

/// How far a variant is: where it has transients, these alone count, for they take the time.
class Share {
    std::size_t all_ = 0, transients_ = 0, done_ = 0;
    double last_ = 0;

public:
    explicit Share(const Circuit& circuit) {
        for (const auto& c : circuit.commands) all_ += analysis_of(c.name) != nullptr, transients_ += c.name == "tran";
    }
    double of(std::string_view word, double share) {
        if (transients_ > 0 && word != "tran") return static_cast<double>(done_) / static_cast<double>(transients_);
        if (share < last_) ++done_;
        last_ = share;
        return (static_cast<double>(done_) + share) / static_cast<double>(transients_ > 0 ? transients_ : std::max<std::size_t>(all_, 1));
    }
};

std::size_t analyses_of(const Circuit& circuit) {
    return static_cast<std::size_t>(
        std::count_if(circuit.commands.begin(), circuit.commands.end(), [](const Command& c) { return analysis_of(c.name) != nullptr; }));
}

/// Makes the bench of a variant, if the last one's does not serve.
Result<void> prepare(std::unique_ptr<TestBench>& bench, const Variant& variant, bool brief) {
    if (!bench || bench->circuit != variant.circuit) {
        auto made = TestBench::make(variant.circuit);
        if (!made) return made.error();
        bench = std::move(*made);
    }
    bench->brief = brief;
    if (variant.draw) bench->draw(*variant.draw);
    return {};
}

Result<void> run_all(Variants& variants, const RunWords& words, const Common& common, Report& report, CurveFiles& files) {
    const auto count = variants.count();
    Progress progress(common.quiet);
    std::unique_ptr<TestBench> bench;
    for (std::size_t k = 0; k < count; ++k) {
        auto variant = variants.at(k);
        if (!variant) return variant.error();
        if (auto ok = prepare(bench, *variant, k > 0 || variants.draws()); !ok) return ok;
        if (k == 0)
            if (auto ok = files.check(analyses_of(*variant->circuit)); !ok) return ok;
        Share variant_share(*variant->circuit);
        Gathered gathered;
        RunOrders orders;
        orders.keep = false, orders.print = !common.json && !common.quiet;
        if (common.json) orders.curves = &gathered;
        if (!words.out.empty()) orders.curves = &files, files.next(*variant);
        orders.stop = [&](std::string_view word, double share) {
            progress.at((static_cast<double>(k) + variant_share.of(word, share)) / static_cast<double>(count));
            return interrupted();
        };
        Accountant accountant(*bench);
        const auto watched = words.budget ? accountant.watch(orders) : Result<void>();
        auto found = watched ? circuit::run(*bench, orders) : watched.error();
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
        auto plots = words.out.empty() ? std::move(gathered.plots) : found->plots();
        Done done{std::move(*variant), std::move(*found), std::move(plots)};
        if (words.budget) {
            auto cost = accountant.found();
            if (!cost) return cost.error();
            done.cost = std::move(*cost);
        }
        report.add(done);
    }
    return {};
}

/// What a run that was broken off leaves behind.
void keep_what_there_is(CurveFiles& files) {
    const auto remark = files.finish_early(interrupted());
    if (!remark)
        fail(remark.error());
    else if (!remark->empty())
        tell_warning(*remark);
}

/// "summer.N3B=8x4"
Result<Knob> knob_of(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
        return bad_usage(fmt::format("--set {}: write NAME=VALUE, such as 'C_u=4pF'", text));
    return Knob{text.substr(0, equals), text.substr(equals + 1), "--set " + text};
}

/// The netlist with what is set of it, and with what is to be saved beside its own.
Result<Netlist> netlist_of(const RunWords& words) {
    auto knobs = knobs_of(words.netlists);
    for (const auto& text : words.settings) {
        auto knob = knob_of(text);
        if (!knob) return knob.error();
        knobs.push_back(std::move(*knob));
    }
    auto netlist = tuned(words.netlist, knobs);
    if (!netlist || words.netlists.traces.empty()) return netlist;
    const auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error();
    auto changes = netlist->changes();
    for (const auto& word : traces_of(words.netlists)) {
        const auto found = traced(*circuit, word);
        if (!found) return found.error();
        if (!*found)
            return bad_input(fmt::format("--trace {}: {} has no such node or device{}", word, words.netlist, meant_trace(*circuit, word)));
        changes.saved.push_back(**found);
    }
    return netlist->with(std::move(changes));
}

Result<void> run_netlist(const RunWords& words, const Common& common) {
    const auto netlist = netlist_of(words);
    if (!netlist) return netlist.error();
    auto variants = Variants::of(*netlist);
    if (!variants) return variants.error();
    const bool several = variants->count() > 1;
    Report report(common, several, variants->draws());
    CurveFiles files(words, several, common.overwrite);
    const auto done = run_all(*variants, words, common, report, files);
    report.finish();
    if (!done) return keep_what_there_is(files), done;
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
