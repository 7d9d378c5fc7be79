#pragma once
// A study makes again what somebody printed, or asks a question of the models, and says what came out beside what was printed.

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// A number made here, beside one that was printed.
struct Claim {
    std::string what;
    double made = 0;
    std::string unit = {};
    double printed = std::numeric_limits<double>::quiet_NaN();          ///< NaN: only the range, or nothing, was printed
    double low = std::numeric_limits<double>::quiet_NaN(), high = low;  ///< what is allowed, if that is said
    std::string source = {};                                            ///< of what was printed
    std::string note = {};                                              ///< why it differs, where it does

    bool judged() const { return low == low || high == high; }
    bool holds() const { return !(made < low) && !(made > high); }
};

/// Something to look at: lines, points or rows of spikes over a common axis.
struct Plot {
    enum class Style { line, points, raster };
    struct Series {
        std::string name;
        std::vector<double> x, y;
        Style style = Style::line;
    };
    std::string title, x_label, y_label;
    std::vector<Series> series;
    bool log_x = false, log_y = false;
};

struct Outcome {
    std::vector<Claim> claims;
    std::vector<Plot> plots;
    std::vector<std::string> notes;  ///< what was learned, and what is left out
};

struct StudyOptions {
    /// Called with the share done, 0 to 1; false stops the study.
    std::function<bool(double)> keep_on = [](double) { return true; };
};

struct Study {
    std::string_view name, title;
    std::string_view question;  ///< and where it comes from
    Result<Outcome> (*run)(const StudyOptions&);
};

}  // namespace corpuscle
