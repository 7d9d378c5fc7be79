#include "run/trials/trial_option_group.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// "FROM..TO", s.
Result<std::pair<double, double>> parse_window(const std::string& text) {
    const auto dots = text.find("..");
    const auto from = parse_quantity(text.substr(0, dots), "s"),
               to = dots == std::string::npos ? from : parse_quantity(text.substr(dots + 2), "s");
    if (dots == std::string::npos || !from || !to || !(*from < *to))
        return bad_usage(fmt::format("{}: write FROM..TO with FROM before TO, in seconds, such as -0.1..0.5 or -100ms..500ms", text));
    return std::pair(*from, *to);
}

}  // namespace

OptionGroup trial_option_group(TrialOptions& options) {
    const auto read_table = [&options](const std::string& text) {
        (text == "onset" ? void(options.are_contacts = true) : void(options.table = text));
        return Result<void>();
    };
    const auto read_alignment = [&options](const std::string& text) {
        options.alignment = text == "onset" ? AlignmentPoint::onset : AlignmentPoint::start;
        return Result<void>();
    };
    return {"Trials",
            {{"--trials", read_table, "FILE|onset",
              "compare parts of a recording: a table start,stop,label, an NWB file, or 'onset' for each contact (doc/trials.md). Without it, each FORCE "
              "is a trial if --align, --window or --by is given"},
             split_at_commas({"--by", list_reader(options.by, [](const std::string& name) { return Result<std::string>(name); }), "COLUMN",
                              "the recording has several trials one below another: each value of this column (or of several: a,b) is a trial of "
                              "its own"}),
             {"--label", &options.label, "COLUMN", "column of the labels, in the table of --trials or with --by in the recording"},
             {"--align", read_alignment, "POINT", "time 0 of a trial: its start (default), or the onset of its first contact",
              one_of("start", "onset")},
             {"--window", value_reader(options.window, parse_window), "FROM..TO",
              "measure this time around the point of alignment, such as -0.1..0.5 (default: the complete trial)"},
             {"--onset-threshold", quantity_reader(options.onset_threshold, "N"), "FORCE",
              "force of a contact onset, summed over channels (default: above the noise at rest)"}}};
}

Result<void> check_trial_options(const TrialOptions& options) {
    if (!options.by.empty() && (!options.table.empty() || options.are_contacts))
        return bad_usage("--by and --trials exclude each other: with --by, each trial is a complete recording");
    if (options.onset_threshold && !options.uses_onsets()) return bad_usage("--onset-threshold needs --align onset or --trials onset");
    if (options.label && options.table.empty() && options.by.empty())
        return bad_usage(fmt::format("--label {}: a column of the table of --trials, or of the recording with --by", *options.label));
    return {};
}

}  // namespace corpuscle
