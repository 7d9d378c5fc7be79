#pragma once
// A study reproduces a published result, or answers a question about the models. It lists computed values beside published ones.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "reproduction/claims/claim.hpp"
#include "reproduction/claims/study_plot.hpp"
#include "run/export/kit_request.hpp"

namespace corpuscle {

struct StudyResult {
    std::vector<Claim> claims;
    std::vector<StudyPlot> plots;
    std::vector<std::string> notes;  ///< findings, and the limits of the study
    /// The kind of the claims that are added next; empty: that of the study.
    std::optional<ClaimKind> next_kind = {};

    /// Adds a computed number. The published value is added to the claim: claim("V_Q", v, "V").published_as(350.1e-3, "table 17").
    Claim& claim(std::string label, double computed, std::string unit = {}) {
        return claims.emplace_back(Claim{.label = std::move(label), .computed = computed, .unit = std::move(unit), .kind = next_kind});
    }
    /// Adds a statement, `label`, that is expected to be true.
    Claim& claim_true(std::string label, bool is_true, std::string source) {
        return claims.emplace_back(Claim{.label = std::move(label),
                                         .computed = is_true ? 1.0 : 0.0,
                                         .allowed_min = 1,
                                         .source = std::move(source),
                                         .is_boolean = true,
                                         .kind = next_kind});
    }
    /// Adds a plot, which has no series yet.
    StudyPlot& plot(std::string title, std::string x_label, std::string y_label, bool log_x = false, bool log_y = false) {
        return plots.emplace_back(StudyPlot{std::move(title), std::move(x_label), std::move(y_label), {}, log_x, log_y});
    }
    void note(std::string text) { notes.push_back(std::move(text)); }
};

struct StudyOptions {
    /// Called with the completed fraction, 0 to 1. If it returns false, the study stops.
    std::function<bool(double)> should_continue = [](double) { return true; };
    std::string recordings_folder = {};  ///< the folder with the published recordings; only for recorded_studies

    KitRequest kit = {};  ///< the kit of a foundry; only for kit_studies

    /// Calls should_continue. If that returns false, returns an error of code `interrupted`, which the study passes on.
    Result<void> report_progress(double fraction) const { return should_continue(fraction) ? Result<void>() : interrupted_error(); }
    /// The path of a folder of recordings; an error if it does not exist.
    Result<std::string> recordings_in(std::string_view folder) const;
};

struct Study {
    std::string_view name, title;
    std::string_view question;  ///< the published statement or the question, and its source
    ClaimKind kind;             ///< of the claims that state no other
    std::function<Result<StudyResult>(const StudyOptions&)> compute;
    /// The folder within StudyOptions::recordings_folder that the study reads; "" if it reads no recording.
    std::string_view recording_folder = {};

    /// Runs the study, and gives each claim its kind. If should_continue stops it, returns an error of code `interrupted`.
    Result<StudyResult> run(const StudyOptions& options) const {
        TRY(options.report_progress(0));
        auto outcome = compute(options);
        if (!outcome) return outcome;
        for (auto& c : outcome->claims)
            if (!c.kind) c.kind = kind;
        TRY(options.report_progress(1));
        return outcome;
    }
};

/// Runs these studies, several in parallel, and returns their results in the same order. After the first error the other studies are
/// stopped.
Result<std::vector<StudyResult>> run_studies(std::span<const Study* const>, const StudyOptions&);

}  // namespace corpuscle
