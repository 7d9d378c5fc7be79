#include "circuit/output/curve_selector.hpp"

namespace corpuscle::circuit {
namespace {

struct SelectedCurve {  // a curve and the name by which it was selected
    std::string name;
    CurveView view;
};

/// The named curves that the plot has.
std::vector<SelectedCurve> find_selected(const Plot& plot, const std::vector<std::string>& names) {
    std::vector<SelectedCurve> out;
    const CurveIndex index(plot);
    for (const auto& name : names)
        if (const auto view = CurveView::find(plot, name, &index)) out.push_back({name, *view});
    return out;
}

/// The swept quantity and the selected curves, without values.
Plot selected_head(const Plot& plot, const std::vector<SelectedCurve>& curves) {
    Plot out{plot.name, plot.is_complex, plot.has_sweep, {}};
    if (plot.has_sweep && !plot.curves.empty()) out.curves.push_back({plot.curves[0].name, plot.curves[0].type, {}});
    for (const auto& c : curves) out.curves.push_back({c.name, c.name[0] == 'v' ? "voltage" : "current", {}});
    return out;
}

}  // namespace

Plot select_curves(const Plot& plot, const std::vector<std::string>& names) {
    const auto curves = find_selected(plot, names);
    if (curves.empty()) return plot;
    Plot out = selected_head(plot, curves);
    if (plot.has_sweep) out.curves[0].values = plot.curves[0].values;
    for (std::size_t k = 0; k < curves.size(); ++k) out.curves[k + plot.has_sweep].values = curves[k].view.all_values(plot);
    return out;
}

Plot CurveSelector::begin(const Plot& head, const std::vector<std::string>& names) {
    const auto curves = find_selected(head, names);
    keeps_all_ = curves.empty();
    views_.clear();
    for (const auto& c : curves) views_.push_back(c.view);
    return keeps_all_ ? head : selected_head(head, curves);
}

std::span<const double> CurveSelector::select(std::span<const double> row) {
    if (keeps_all_) return row;
    row_.assign(1, row[0]);  // the swept quantity
    for (const auto& view : views_) row_.push_back(view.value(PlotRow(row)).real());
    return row_;
}

}  // namespace corpuscle::circuit
