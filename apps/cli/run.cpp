// corpuscle run: the analyses written in a netlist.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "circuit/raw.hpp"
#include "circuit/run.hpp"
#include "io/output.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json column(const Plot& plot, const Curve& curve) {
    Json out = Json::array();
    for (const auto& x : curve.values) out.push_back(plot.is_complex && curve.type != "frequency" ? Json({number(x.real()), number(x.imag())}) : number(x.real()));
    return out;
}

Json document_of(const Circuit& circuit, const RunOutcome& outcome) {
    Json plots = Json::array(), numbers = Json::object(), expectations = Json::array(), remarks = Json::array();
    for (const auto& a : outcome.analyses)
        for (const auto& plot : a.findings.plots) {
            Json curves = Json::object();
            for (const auto& c : plot.curves) curves[c.name] = column(plot, c);
            plots.push_back({{"analysis", a.command->name}, {"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves}});
        }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back({{"what", e.what}, {"found", number(e.found)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"holds", e.held}});
    for (const auto& r : outcome.remarks) remarks.push_back(r.text());
    return {{"title", circuit.title}, {"plots", plots}, {"numbers", numbers}, {"expectations", expectations}, {"warnings", remarks}};
}

/// x.csv of one plot; of several x-1.csv, x-2.csv ...
Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    if (auto ok = file->write(text); !ok) return ok;
    return file->commit();
}

Result<void> write(const RunWords& words, const Circuit& circuit, const RunOutcome& outcome) {
    if (words.out.empty()) return {};
    const auto plots = outcome.plots();
    if (!words.out.ends_with(".csv")) return write_file(words.out, raw_text(circuit.title, plots, !words.ascii));
    for (std::size_t k = 0; k < plots.size(); ++k) {
        auto path = words.out;
        if (plots.size() > 1) path.insert(path.size() - 4, fmt::format("-{}", k + 1));
        if (auto ok = write_file(path, csv_text(plots[k])); !ok) return ok;
    }
    return {};
}

void print(const Circuit& circuit, const RunOutcome& outcome) {
    for (const auto& a : outcome.analyses) {
        const auto columns = printed(circuit, a);
        std::size_t points = 0;
        if (!a.findings.plots.empty()) points = a.findings.plots[0].points();
        fmt::print("{}.{}: {} point{}\n", &a == &outcome.analyses[0] ? "" : "\n", a.command->name, points, points == 1 ? "" : "s");
        fmt::print("{}{}", a.findings.table, columns);
    }
    if (!outcome.numbers.empty()) fmt::print("\n");
    for (const auto& [name, value] : outcome.numbers)
        std::isnan(value) ? fmt::print("{:20} = failed\n", name) : fmt::print("{:20} = {:.6e}\n", name, value);
    for (const auto& e : outcome.expectations)
        fmt::print("{:20} = {:.6e}, expected {:g} within {:g}: {}\n", e.what, e.found, e.expected, e.tolerance, e.held ? "holds" : "does not hold");
}

Result<void> run_netlist(const RunWords& words, const Common& common) {
    const auto netlist = Netlist::read(words.netlist);
    if (!netlist) return netlist.error();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error();
    const auto shared = std::make_shared<const Circuit>(std::move(*circuit));
    std::optional<RunOutcome> outcome;
    {
        Progress progress(common.quiet);
        auto found = run(shared, [&](std::string_view, double share) { return progress.at(share), interrupted(); });
        if (!found) return found.error();
        outcome = std::move(*found);
    }
    for (const auto& r : outcome->remarks) fmt::print(stderr, "corpuscle: warning: {}\n", r.text());
    if (auto ok = write(words, *shared, *outcome); !ok) return ok;
    if (common.json)
        fmt::print("{}\n", document_of(*shared, *outcome).dump(1));
    else if (!common.quiet)
        print(*shared, *outcome);
    for (const auto& e : outcome->expectations)
        if (!e.held) return bad_input(fmt::format("{} is {:g}, not {:g} within {:g}", e.what, e.found, e.expected, e.tolerance), e.place);
    return {};
}

}  // namespace

int run(const RunWords& words, const Common& common) {
    catch_interrupt();
    const auto done = run_netlist(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
