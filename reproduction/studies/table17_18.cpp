// Tables 17 and 18: the A_VT that tables 11 and 12 imply.

#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"
#include "reproduction/thesis/bias/bias_chips.hpp"

namespace corpuscle::studies::table17_18 {

/// A_VT_of_tables (V um), the mean of the seven arrays of table 12. For each array the variance due to A_IS is subtracted from the
/// published variance, and the rest divided by g_mg/I_D. This ratio and the area are computed from the published g_mg, so that misprints of
/// the columns A and g_mg/I_D (errata U11, U12) have no effect.
Result<StudyValues> compute_values(const StudyOptions&) {
    const auto circuit = TRY(elaborate_study_netlist({"bias"}));
    const auto m4a = static_cast<std::size_t>(circuit->find_element("m4a"));
    const double A_IS = 1e6 * bias_chips::model_parameter(*circuit, m4a, "ais");
    double mean = 0;
    for (const auto& a : published_rectangles) {
        const double variance = 1e-4 * a.sigma * a.sigma * a.g_mg / a.g_by_A;
        mean += std::sqrt(variance - A_IS * A_IS) / (a.g_mg / a.I_D) / static_cast<double>(std::size(published_rectangles));
    }
    return StudyValues{{"A_VT_of_tables", mean}};
}

}  // namespace corpuscle::studies::table17_18
