// corpuscle fit transistor: a UICM card from I-V curves.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/ascii_text.hpp"
#include "fit/transistor/fitted_card.hpp"
#include "io/output/output_check.hpp"
#include "report/page_file.hpp"
#include "report/transistor/transistor_page.hpp"

namespace corpuscle {
namespace {

constexpr const char* transistor_examples =
    R"(I-V curves of transistors, measured or simulated -> a process card of UICM (level=80), with 95 %
intervals. DATA are tables of text, or .raw files of SPICE with .dc sweeps.

Examples:
  corpuscle fit transistor curves.csv --width 1.5um --length 0.5um
  corpuscle fit transistor nmos.raw -W 1.5u -L 0.5u --card nch.lib --name nch --report nch.html
  corpuscle fit transistor cold.csv hot.csv --temperature=-20,85 -W 1.5u -L 0.5u --card nch.lib
  corpuscle fit transistor curves.csv --column i_d=Current --column v_gs=Gate --vds 50mV
  corpuscle fit transistor chips.csv --fit all,gamma --set tcv=-1m

A table has a header. The columns are found by their usual names, with a unit if it is not SI:
  v_g v_d v_s v_b    or VG VD ...; without a column the source is at 0 V, the bulk at the source
  VGS VDS VBS        the same, referred to the source
  I_D, I_B           into the terminal, such as 'I_D (uA)'; I_B is optional
  T, W, L, device    temperature in C, or 'T (K)'; size; name or number of the device or chip
In a .raw file they are v(g), v(d) ... and i(vd), the current through the voltage source at the
drain, whose sign is opposite. --column names any other column.

Fitted are vto, isq, n, sigmal (DIBL), zetal (velocity saturation), ve (Early voltage), js and nj
(junctions), tcv and tis (temperature), avt and ais (mismatch). What the data do not determine is
listed with the reason and the data that would determine it; such a value has no effect in the
card, or its default. --fit refuses what the data do not determine. --fit avt,ais also fits the
card. gamma (body effect) and jssw are fitted only if named.

The first values follow from g_m/I_D. Then least squares with exact slopes: each point weighs by
its noise, a fraction of its current and a floor, which are estimated from the residuals unless
--noise and --floor give them. doc/fit-transistor.md tells how to measure, and how well it fits.)";

struct TransistorArguments {
    std::vector<std::string> data;
    IvOptions iv;
    TransistorFitRequest request;
    std::string type, card, name, report;
};

/// Splits "-20,27,85" into a list of quantities.
OptionRow quantity_list(std::string_view names, std::vector<double>& to, std::string_view unit, std::string_view value,
                        std::string_view description) {
    return split_at_commas({names, list_reader(to, quantity_of(unit)), value, description});
}

OptionReader word_list(std::vector<std::string>& to) {
    return list_reader(to, [](const std::string& word) { return Result<std::string>(word); });
}

/// Sets a value of the card: "cox=8m".
Result<void> set_card_value(TransistorFitRequest& request, const std::string& text) {
    const auto equals = text.find('=');
    const auto name = lower(trimmed(std::string_view(text).substr(0, equals)));
    std::vector<std::string_view> names;
    for (const auto& f : circuit::UicmCard::fields) {
        names.push_back(f.name);
        if (name != f.name || equals == text.npos) continue;
        const auto unit = parse_unit(f.unit) ? f.unit : std::string_view();  // some have no name, such as V^0.5
        const auto value = parse_quantity(std::string_view(text).substr(equals + 1), unit);
        if (!value) return bad_usage(value.error().message);
        const ParameterInfo info{f.name, f.unit, 0, f.low, f.high, f.description, {}};
        if (const auto ok = check_range("card", info, *value); !ok) return bad_usage(ok.error().message);
        request.base.*f.member = *value, request.given.push_back(name);
        return {};
    }
    return bad_usage(fmt::format("'{}': write NAME=VALUE in SI, such as cox=8m; NAME is one of {}", text, joined(names)));
}

bool is_own_card(std::string_view beginning) { return beginning.starts_with(card_signature); }

std::string misfit_text(const TransistorFit& fit) {
    const auto& m = fit.misfit;
    auto out = fmt::format("\nI_D: rms difference {}, largest {}, in {} points; scatter between neighbours {}\n", percent_text(m.rms),
                           percent_text(m.largest), m.points, percent_text(m.scatter));
    if (m.gm_over_ID) out += fmt::format("g_m/I_D: rms difference {}\n", percent_text(*m.gm_over_ID));
    if (m.bulk_rms) out += fmt::format("I_B: rms difference {}\n", percent_text(*m.bulk_rms));
    out += fmt::format("noise: {} of the current, floor {}", percent_text(fit.drain_noise.relative),
                       format_quantity(fit.drain_noise.floor, "A"));
    if (m.chi_squared) out += fmt::format("; chi squared per degree of freedom {:.3g}", *m.chi_squared);
    return out + "\n";
}

std::string fit_text(const TransistorFit& fit) {
    TableRows rows = {{"parameter", "card", "value", "95 % interval"}};
    std::string reasons;
    for (const auto& v : fit.values) {
        rows.push_back({v.name, v.card_name, card_value_text(v), card_interval_text(v)});
        if (!v.reason.empty()) reasons += fmt::format("{}: {}\n", v.card_name, v.reason);
    }
    auto out = format_table(rows) + misfit_text(fit);
    if (!reasons.empty()) out += "\nNot determined:\n" + reasons;
    return out;
}

std::string model_name(const TransistorArguments& args, const TransistorFit& fit) {
    return !args.name.empty() ? args.name : fit.is_pmos ? "pch" : "nch";
}

Result<void> check_outputs(const TransistorArguments& args, const CommonArguments& common) {
    OutputCheck check(common.overwrite);
    if (!args.card.empty()) TRY(check.check_file(args.card, is_own_card));
    if (!args.report.empty()) TRY(check_page_path(args.report));
    return {};
}

Result<void> fit_transistor_card(const TransistorArguments& args, const CommonArguments& common) {
    auto options = args.iv;
    if (!args.type.empty()) options.is_pmos = args.type == "pmos";
    const auto data = TRY(read_iv_files(args.data, options));
    TRY(check_outputs(args, common));
    const auto fit = TRY(fit_transistor(data, args.request));
    print_notes(args.data[0], fit.notes, common.quiet);
    if (!fit.is_geometry_known)
        print_warning(
            "W and L are unknown: I_SQ is I_SQ W / L of this device, and the card is right for w=1u l=1u; give --width and --length");
    constexpr double doubtful = 0.3;
    if (fit.misfit.rms > doubtful)
        print_warning(
            fmt::format("the card differs from the curves by {} rms: check the units in the heads of the columns, the temperature "
                        "(--temperature in Celsius; a head 'T (K)' for kelvin), --width and --length, and single wrong points",
                        percent_text(fit.misfit.rms)));
    if (!fit.is_converged) print_warning("the search has not converged; leave out parameters with --fit, or points far from the model");
    if (!args.card.empty()) TRY(write_file(args.card, card_text(fit, model_name(args, fit), common.complete_command)));
    if (!args.report.empty()) TRY(write_page(args.report, transistor_page(fit, data, common.command)));
    if (common.json)
        fmt::print("{}\n", json_text(document_of(fit, data)));
    else if (!common.quiet)
        print_text(fit_text(fit));
    return {};
}

OptionGroup data_options(TransistorArguments& args) {
    return {"",
            {required({"DATA", &args.data, "", "tables (.csv, .txt, .tsv ...) and .raw files with I-V curves"}),
             repeatable({"--column", list_reader(args.iv.columns, parse_column_choice), "NAME=HEAD",
                         "the column with this head holds NAME; i_d=-HEAD if it has the opposite sign (repeatable)"}),
             {"--type", &args.type, "POLARITY", "polarity (default: from the signs). A PMOS may be given by magnitudes",
              one_of("nmos", "pmos")},
             quantity_list("--width,-W", args.iv.width, "m", "LENGTH", "width, if there is no column: one for all files, or one for each"),
             quantity_list("--length,-L", args.iv.length, "m", "LENGTH", "length, likewise"),
             quantity_list("--temperature", args.iv.temperature, "", "DEGREES", "temperature in degrees Celsius, likewise (default 27)"),
             quantity_list("--vds", args.iv.v_ds, "V", "VOLTAGE", "constant V_DS, likewise"),
             quantity_list("--vbs", args.iv.v_bs, "V", "VOLTAGE", "constant V_BS, likewise (default 0)")}};
}

OptionGroup fit_options(TransistorArguments& args) {
    return {"",
            {split_at_commas({"--fit,-f", word_list(args.request.fit), "NAME",
                              "fit exactly these; 'all' stands for all that the data determine (default)"}),
             repeatable({"--set,-s", OptionReader([&args](const std::string& text) { return set_card_value(args.request, text); }),
                         "NAME=VALUE", "keep this value of the card, in SI: cox=8m, tcv=-1m (repeatable)"}),
             {"--noise", value_reader(args.request.relative_noise, quantity_of("")), "FRACTION", "noise of a current relative to it: 1%"},
             {"--floor", value_reader(args.request.noise_floor, quantity_of("A")), "CURRENT", "noise of a current of 0: 1pA"},
             {"--card,-o", &args.card, "FILE", "write the card: a file with a .model line for .include"},
             {"--name", &args.name, "MODEL", "name of the model in the card (default nch or pch)"},
             {"--report", &args.report, "FILE.html", "write a page with the curves and their residuals"}}};
}

Result<void> check_arguments(const TransistorArguments& args) {
    TRY(check_page_name(args.report));
    const auto& r = args.request;
    if (r.relative_noise && !(*r.relative_noise > 0 && *r.relative_noise < 1))
        return bad_usage(fmt::format("--noise {}: must be between 0 and 1, such as 1%", *r.relative_noise));
    if (r.noise_floor && !(*r.noise_floor > 0)) return bad_usage(fmt::format("--floor {}: must be above 0, such as 1pA", *r.noise_floor));
    const bool is_word = std::all_of(args.name.begin(), args.name.end(), [](char c) {
        return c == '_' || c == '.' || (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z');
    });
    return is_word ? Result<void>() : bad_usage(fmt::format("--name {}: letters, digits, '_' and '.' only, such as nch", args.name));
}

}  // namespace

Verb make_fit_transistor_verb() {
    const auto args = std::make_shared<TransistorArguments>();
    return {.name = "transistor",
            .description = "fit a process card of UICM to I-V curves -> values, intervals, a .lib file",
            .examples = transistor_examples,
            .options = {data_options(*args), fit_options(*args)},
            .reports = true,
            .writes_files = true,
            .check = [args](const CommonArguments&) { return check_arguments(*args); },
            .run = interruptible(args, fit_transistor_card)};
}

}  // namespace corpuscle
