// corpuscle run: the analyses written in a netlist.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

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
    for (const auto& a : outcome.analyses)
        for (const auto& plot : a.findings.plots) {
            Json curves = Json::object();
            for (const auto& curve : plot.curves) curves[curve.name] = column(plot, curve);
            plots.push_back({{"analysis", a.command->name}, {"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves}});
        }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back(
            {{"what", e.what}, {"found", number(e.found)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"holds", e.held}});
    for (const auto& r : outcome.remarks) remarks.push_back(r.text());
    return {{"title", c.title}, {"plots", plots}, {"numbers", numbers}, {"expectations", expectations}, {"warnings", remarks}};
}

Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    if (auto ok = file->write(text); !ok) return ok;
    return file->commit();
}

/// One of the circuits that a netlist asks for, and what was found.
struct Done {
    Variant variant;
    RunOutcome outcome;
};

/// A .raw file of all plots; x.csv of one plot, of several x-1.csv, x-2.csv ...
Result<void> write(const RunWords& words, std::span<const Done> all) {
    if (words.out.empty()) return {};
    std::vector<Plot> plots;
    for (const auto& done : all)
        for (auto plot : done.outcome.plots()) {
            if (!done.variant.label.empty()) plot.name += fmt::format(" ({})", done.variant.label);
            plots.push_back(std::move(plot));
        }
    if (!words.out.ends_with(".csv")) return write_file(words.out, raw_text(all[0].variant.circuit->title, plots, !words.ascii));
    for (std::size_t k = 0; k < plots.size(); ++k) {
        auto path = words.out;
        if (plots.size() > 1) path.insert(path.size() - 4, fmt::format("-{}", k + 1));
        if (auto ok = write_file(path, csv_text(plots[k])); !ok) return ok;
    }
    return {};
}

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

Result<void> run_netlist(const RunWords& words, const Common& common) {
    const auto netlist = Netlist::read(words.netlist);
    if (!netlist) return netlist.error();
    const auto variants = Variants::of(*netlist);
    if (!variants) return variants.error();
    const auto count = variants->count();
    std::vector<Done> all;
    {
        Progress progress(common.quiet);
        for (std::size_t k = 0; k < count; ++k) {
            auto variant = variants->at(k);
            if (!variant) return variant.error();
            auto found = circuit::run(variant->circuit, [&](std::string_view, double share) {
                progress.at((static_cast<double>(k) + share) / static_cast<double>(count));
                return interrupted();
            });
            if (!found) {
                auto error = found.error();
                if (!variant->label.empty()) error.sentence = fmt::format("{}: {}", variant->label, error.sentence);
                return error;
            }
            if (interrupted()) return Error{Code::interrupted, "interrupted"};
            all.push_back({std::move(*variant), std::move(*found)});
        }
    }
    for (const auto& done : std::span(all).first(1))
        for (const auto& r : done.outcome.remarks) fmt::print(stderr, "corpuscle: warning: {}\n", r.text());
    if (auto ok = write(words, all); !ok) return ok;
    Json documents = Json::array();
    for (const auto& done : all) {
        if (common.json) {
            documents.push_back(document_of(*done.variant.circuit, done.outcome));
            if (count > 1) documents.back()["step"] = done.variant.label;
        } else if (!common.quiet) {
            count > 1 ? print_line(done) : print(done);
        }
    }
    if (common.json) fmt::print("{}\n", (count > 1 ? documents : documents[0]).dump(1));
    for (const auto& done : all)
        for (const auto& e : done.outcome.expectations)
            if (!e.held)
                return bad_input(
                    fmt::format("{}{} is {:g}, not {:g} within {:g}", done.variant.label.empty() ? "" : done.variant.label + ": ", e.what,
                                e.found, e.expected, e.tolerance),
                    e.place);
    return {};
}

}  // namespace

int run(const RunWords& words, const Common& common) {
    catch_interrupt();
    const auto done = run_netlist(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
