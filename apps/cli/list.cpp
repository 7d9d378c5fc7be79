// corpuscle list: prints the catalogues.

#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/list_sites.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "model/catalog.hpp"
#include "run/catalogue/catalogue_document.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// A section and its entries.
struct ListSection {
    std::string_view name;
    std::vector<ListEntry> entries;
};

std::vector<ListSection> all_sections() {
    std::vector<ListSection> all;
    for (const auto& section : catalogue_sections()) all.push_back({section.name, section.entries()});
    return all;
}

/// The sections and entries that are named in `what`; all sections if it is empty.
Result<std::vector<ListSection>> select_sections(const std::vector<std::string>& what) {
    auto all = all_sections();
    if (what.empty()) return all;
    std::vector<ListSection> out;
    std::vector<std::string_view> known;
    for (const auto& s : all) {
        known.push_back(s.name);
        for (const auto& e : s.entries) known.push_back(e.name);
    }
    for (const auto& typed : what) {
        const auto plan = plan_afferent(typed);
        const std::string name =
            plan && typed.find('+') == std::string::npos ? plan->name : typed;  // TouchSim's SA1, RA ... are sa1, fa1 ...
        if (std::find(known.begin(), known.end(), name) == known.end())
            return bad_usage(fmt::format("list: there is no '{}'{}", name, did_you_mean(name, known)));
        for (const auto& s : all) {
            if (s.name == name) {
                out.push_back(s);
                continue;
            }
            ListSection selected{s.name, {}};
            std::copy_if(s.entries.begin(), s.entries.end(), std::back_inserter(selected.entries),
                         [&](const ListEntry& e) { return e.name == name; });
            if (!selected.entries.empty()) out.push_back(selected);
        }
    }
    return out;
}

/// "[LOW, HIGH]"; "" without a range.
std::string range_text(const ParameterInfo& r) {
    if (!has_range(r)) return "";
    return fmt::format("[{}, {}]", format_quantity(r.low, r.unit), format_quantity(r.high, r.unit));
}

std::string text_of(const ListEntry& e) {
    std::string text = fmt::format("  {}{}: {}\n", e.name, e.detail.empty() ? "" : fmt::format(" ({})", e.detail), e.description);
    if (!e.source.empty()) text += fmt::format("    source: {}\n", e.source);
    if (!e.other_names.empty()) text += fmt::format("    also called: {}\n", joined(e.other_names));
    TableRows rows;
    for (const auto& p : e.parameters)
        rows.push_back({"    " + std::string(p.info.name), format_quantity(p.info.default_value, p.info.unit), range_text(p.info),
                        std::string(p.info.description) + (p.info.source.empty() ? "" : fmt::format(" ({})", p.info.source))});
    for (const auto& t : e.notes) rows.push_back({"    " + t.subject, t.text, t.source.empty() ? "" : "(" + t.source + ")"});
    return text + format_table(rows, false);
}

struct ListArguments {
    std::vector<std::string> names;
    bool list_sites = false;  // list the sites of the population that `names` contains
};

Result<void> print_sections(const ListArguments& args, const CommonArguments& common) {
    const auto sections = TRY(select_sections(args.names));
    if (common.json) {
        Json out = Json::object();
        for (const auto& s : sections)
            for (const auto& e : s.entries) out[std::string(s.name)].push_back(document_of(e));
        fmt::print("{}\n", json_text(out));
        return {};
    }
    std::string text;
    for (const auto& s : sections) {
        text += fmt::format("{}{}\n", text.empty() ? "" : "\n", s.name);
        for (const auto& e : s.entries) text += text_of(e);
    }
    print_text(text);
    return {};
}

Result<void> print_sites(const ListArguments& args, const CommonArguments& common) {
    const auto sites = TRY(sites_listing(args.names, common.json));
    fmt::print("{}", sites);
    return {};
}

}  // namespace

Verb make_list_verb() {
    const auto args = std::make_shared<ListArguments>();
    return {
        .name = "list",
        .description = "list all models, stimuli, circuits ... with the default, range and description of every parameter",
        .examples =
            "Examples:\n  corpuscle list\n  corpuscle list neurons\n  corpuscle list sa1 press\n  corpuscle list 'grid 4x4' --sites",
        .options = {{"",
                     {suggesting(catalogue_names, {"WHAT", &args->names, "",
                                                   "afferents, sensors, transducers, converters, receptors, neurons, stimuli, measures, "
                                                   "formats, or the name of an entry"}),
                      {"--sites", &args->list_sites, "",
                       "print the sites of a population (hand, 'grid 4x4', own.toml) in frame order, as CSV: name, x_mm, y_mm, region"}}}},
        .reports = true,
        .run = [args](const CommonArguments& common) {
            return exit_status(args->list_sites ? print_sites(*args, common) : print_sections(*args, common));
        }};
}

}  // namespace corpuscle
