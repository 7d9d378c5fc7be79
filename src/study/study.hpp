#pragma once
// A study makes again what somebody printed, or asks a question of the models, and says what came out beside what was printed.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"
#include "study/claim.hpp"
#include "study/plot.hpp"

namespace corpuscle {

struct Outcome {
    std::vector<Claim> claims;
    std::vector<Plot> plots;
    std::vector<std::string> notes;  ///< what was learned, and what is left out

    /// A number made here; what it is held against follows: claim("V_Q", v, "V").printed_as(350.1e-3, "table 17").
    Claim& claim(std::string what, double made, std::string unit = {}) {
        return claims.emplace_back(Claim{.what = std::move(what), .made = made, .unit = std::move(unit)});
    }
    /// Whether something is as it was said to be.
    Claim& finds(std::string what, bool is_so, std::string source) {
        return claims.emplace_back(
            Claim{.what = std::move(what), .made = is_so ? 1.0 : 0.0, .low = 1, .source = std::move(source), .is_truth = true});
    }
    Plot& plot(std::string title, std::string x_label, std::string y_label, bool log_x = false, bool log_y = false) {
        return plots.emplace_back(Plot{std::move(title), std::move(x_label), std::move(y_label), {}, log_x, log_y});
    }
    void note(std::string text) { notes.push_back(std::move(text)); }
};

struct StudyOptions {
    /// Called with the share done, 0 to 1; false stops the study.
    std::function<bool(double)> keep_on = [](double) { return true; };
    std::string recordings = {};  ///< the folder in which others' recordings lie, for studies of them

    /// The same, as an error that a study hands on.
    Result<void> at(double share) const { return keep_on(share) ? Result<void>() : Error{Code::interrupted, "interrupted"}; }
};

struct Study {
    std::string_view name, title;
    std::string_view question;  ///< what was printed, in words, or what is asked; and where it comes from
    Result<Outcome> (*work)(const StudyOptions&);
    std::string_view recording = {};  ///< the folder that it needs within StudyOptions::recordings; "": none

    /// Works, unless it is stopped before or after.
    Result<Outcome> run(const StudyOptions& options) const {
        if (auto ok = options.at(0); !ok) return ok.error();
        auto outcome = work(options);
        if (!outcome) return outcome;
        if (auto ok = options.at(1); !ok) return ok.error();
        return outcome;
    }
};

/// All of them, several at once. The first error ends them all.
Result<std::vector<Outcome>> run_studies(std::span<const Study* const>, const StudyOptions&);

}  // namespace corpuscle
