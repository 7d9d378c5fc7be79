#include "report/transistor/transistor_page.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/transistor/fitted_card.hpp"
#include "report/envelope.hpp"
#include "report/page_template.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_plot_curves = 7, max_curve_points = 150;  // in a plot, and of a curve
constexpr const char* terminal_names[] = {"V_D", "V_G", "V_S", "V_B"};

/// At most `most` numbers from 0 to below `count`, evenly spaced.
std::vector<std::size_t> thinned(std::size_t count, std::size_t most) {
    std::vector<std::size_t> out;
    const auto n = std::min(count, most);
    for (std::size_t k = 0; k < n; ++k) out.push_back(n < 2 ? 0 : k * (count - 1) / (n - 1));
    return out;
}

/// A curve by the voltages that stay: "V_D 0.1 V, V_B 0 V, 27 C". Without those that no curve of the plot varies.
std::string label_of(const IvData& data, const IvCurve& curve, int swept) {
    const auto& p = data.points[curve.begin];
    std::string out;
    for (int t = 0; t < 4; ++t) {
        const double v = p.v[static_cast<std::size_t>(t)];
        if ((swept & 1 << t) == 0 && (t == 0 || v != 0)) out += fmt::format("{}{} {:.3g} V", out.empty() ? "" : ", ", terminal_names[t], v);
    }
    if (data.devices.size() > 1)
        out += fmt::format(", {} {:.3g}/{:.3g} um", data.devices[p.device].name, 1e6 * data.devices[p.device].W,
                           1e6 * data.devices[p.device].L);
    return out + fmt::format(", {:g} C", p.temperature);
}

/// A plot of the curves along which one terminal's voltage varies, and one of their differences.
void add_plots(Json& plots, const TransistorFit& fit, const IvData& data, std::size_t terminal) {
    std::vector<IvCurve> curves;
    for (const auto& c : data.curves)
        if (c.swept == 1 << terminal && c.end - c.begin >= 3) curves.push_back(c);
    if (curves.empty()) return;
    const bool is_logarithmic = terminal != 0;
    const std::string name = terminal_names[terminal], x = name + " (V)";
    Json shown = {{"title", "I_D over " + name + ": points measured, lines fitted"},
                  {"x", x},
                  {"y", is_logarithmic ? "|I_D| (A)" : "I_D (A)"},
                  {"log_x", false},
                  {"log_y", is_logarithmic},
                  {"series", Json::array()}};
    Json differences = {{"title", "Difference of I_D, measured to fitted"},
                        {"x", x},
                        {"y", "difference (%)"},
                        {"log_x", false},
                        {"log_y", false},
                        {"series", Json::array()}};
    const double floor = fit.drain_noise.floor;
    std::size_t colour = 0;
    for (const auto c : thinned(curves.size(), max_plot_curves)) {
        const auto& curve = curves[c];
        std::vector<float> V, measured, fitted, difference_V, difference;
        const auto add = [](std::vector<float>& to, double value) { to.push_back(static_cast<float>(value)); };
        for (const auto k : thinned(curve.end - curve.begin, max_curve_points)) {
            const auto& p = data.points[curve.begin + k];
            const double I = fit.currents[curve.begin + k].I_D;
            const auto height = [&](double current) { return is_logarithmic ? std::abs(current) : current; };
            if (is_logarithmic && (p.I_D == 0 || I == 0)) continue;
            add(V, p.v[terminal]), add(measured, height(p.I_D)), add(fitted, height(I));
            if (std::abs(I) > 10 * floor) add(difference_V, p.v[terminal]), add(difference, 100 * (p.I_D / I - 1));
        }
        const auto label = label_of(data, curve, curve.swept);
        const auto series = [&](const std::string& series_name, const auto& voltages, const auto& heights, std::string_view style) {
            return Json{{"name", series_name},
                        {"x", array_document(voltages)},
                        {"y", array_document(heights)},
                        {"style", style},
                        {"colour", colour}};
        };
        shown["series"].push_back(series(label, V, measured, "points"));
        shown["series"].push_back(series("", V, fitted, "line"));
        if (!difference.empty()) differences["series"].push_back(series(label, difference_V, difference, "line"));
        ++colour;
    }
    plots.push_back(shown);
    if (!differences["series"].empty()) plots.push_back(differences);
}

}  // namespace

std::string transistor_page(const TransistorFit& fit, const IvData& data, const std::string& command) {
    const auto& m = fit.misfit;
    Json page = {{"fit", document_of(fit, data)}, {"plots", Json::array()}, {"versions", versions_document()}};
    page["misfit"] = fmt::format("I_D: rms difference {}, largest {}, in {} points; scatter between neighbouring points {}.",
                                 percent_text(m.rms), percent_text(m.largest), m.points, percent_text(m.scatter));
    for (std::size_t k = 0; k < fit.values.size(); ++k) {
        auto& shown = page["fit"]["parameters"][k];
        shown["text"] = card_value_text(fit.values[k]), shown["interval"] = card_interval_text(fit.values[k]);
    }
    for (const std::size_t terminal : {1U, 0U, 3U, 2U}) add_plots(page["plots"], fit, data, terminal);
    return report_page("transistor", fit.is_pmos ? "A PMOS transistor" : "An NMOS transistor", command, page);
}

}  // namespace corpuscle
