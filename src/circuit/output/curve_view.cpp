#include "circuit/output/curve_view.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

constexpr std::string_view part_names[] = {"", "m", "db", "p", "r", "i"};

/// The part of x that is named by the letters between v or i and the parenthesis: "db" in vdb(out). "" is x itself.
std::complex<double> part_of(std::string_view part, std::complex<double> x) {
    if (part == "m") return std::abs(x);
    if (part == "db") return 20 * std::log10(std::abs(x));
    if (part == "p") return std::arg(x);
    if (part == "r") return x.real();
    if (part == "i") return x.imag();
    return x;
}

int index_of(const Plot& plot, std::string_view name, const CurveIndex* index) {
    if (index) return index->index_of(name);
    for (std::size_t k = 0; k < plot.curves.size(); ++k)
        if (plot.curves[k].name == name) return static_cast<int>(k);
    return -1;
}

}  // namespace

CurveIndex::CurveIndex(const Plot& plot) {
    for (std::size_t k = 0; k < plot.curves.size(); ++k) indices_.try_emplace(plot.curves[k].name, static_cast<int>(k));
}

int CurveIndex::index_of(std::string_view name) const {
    const auto at = indices_.find(name);
    return at == indices_.end() ? -1 : at->second;
}

std::complex<double> CurveView::part_of_value(std::complex<double> difference) const { return part_of(part_, difference); }

double CurveView::evaluate_expression(const PlotRow& row) const {
    constexpr std::size_t max_on_stack = 8;
    double on_stack[max_on_stack];
    std::vector<double> on_heap(inputs_.size() > max_on_stack ? inputs_.size() : 0);
    const std::span<double> values = on_heap.empty() ? std::span(on_stack, inputs_.size()) : std::span(on_heap);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = inputs_[k].value(row).real();
    return expression_->value(values);
}

Result<Expression> parse_par_expression(std::string_view name, const SourceLocation& location) {
    ExpressionScope scope;
    scope.allows_inputs = true;
    scope.parameter = [](std::string_view) -> std::optional<double> { return {}; };
    scope.function = [](std::string_view) -> const ExpressionScope::Function* { return nullptr; };
    name.remove_prefix(4), name.remove_suffix(name.ends_with(')'));  // removes "par(" and ")"
    if (name.size() >= 2 && (name[0] == '\'' || name[0] == '{')) name = name.substr(1, name.size() - 2);
    return Expression::parse(name, location, scope);
}

std::optional<CurveView> CurveView::find_expression(const Plot& plot, std::string_view name) {
    auto expression = parse_par_expression(name, {});
    if (!expression || plot.is_complex) return {};
    CurveView out;
    for (const auto& input : expression->inputs()) {
        const auto found = input.kind == ExpressionInput::Kind::time ? find(plot, "time")
                           : input.kind == ExpressionInput::Kind::voltage
                               ? find(plot, "v(" + input.name + "," + (input.minus.empty() ? "0" : input.minus) + ")")
                           : input.kind == ExpressionInput::Kind::current ? find(plot, "i(" + input.name + ")")
                                                                          : std::nullopt;
        if (!found) return {};
        out.inputs_.push_back(*found);
    }
    out.expression_ = std::make_shared<const Expression>(std::move(*expression));
    return out;
}

std::optional<CurveView> CurveView::find(const Plot& plot, std::string_view name, const CurveIndex* index) {
    if (name.starts_with("par(")) return find_expression(plot, name);
    CurveView out;
    const auto open = name.find('(');
    out.is_complex_value_ = open <= 1;
    out.plus_ = index_of(plot, name, index);
    if (out.plus_ >= 0) return out;
    if (open == std::string_view::npos || !name.ends_with(')') || (name[0] != 'v' && name[0] != 'i')) return {};
    const auto* part = std::find(std::begin(part_names), std::end(part_names), name.substr(1, open - 1));
    if (part == std::end(part_names)) return {};
    out.part_ = *part;
    const auto inside = name.substr(open + 1, name.size() - open - 2);
    const auto comma = inside.find(',');
    const auto find_curve = [&](std::string_view node, int& curve) {
        if (node == "0" || node == "gnd") return true;
        curve = index_of(plot, std::string(1, name[0]) + "(" + std::string(node) + ")", index);
        return curve >= 0;
    };
    if (!find_curve(inside.substr(0, comma), out.plus_)) return {};
    if (comma != std::string_view::npos && !find_curve(inside.substr(comma + 1), out.minus_)) return {};
    return out;
}

std::vector<std::complex<double>> CurveView::all_values(const Plot& plot) const {
    std::vector<std::complex<double>> out(plot.point_count());
    if (!expression_) {
        const auto value = [&](int curve, std::size_t k) { return curve < 0 ? 0 : plot.curves[static_cast<std::size_t>(curve)].values[k]; };
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = part_of_value(value(plus_, k) - value(minus_, k));
        return out;
    }
    std::vector<std::vector<std::complex<double>>> inputs;
    for (const auto& input : inputs_) inputs.push_back(input.all_values(plot));
    std::vector<double> values(inputs.size());
    for (std::size_t k = 0; k < out.size(); ++k) {
        for (std::size_t n = 0; n < values.size(); ++n) values[n] = inputs[n][k].real();
        out[k] = expression_->value(values);
    }
    return out;
}

std::optional<std::vector<std::complex<double>>> find_curve_values(const Plot& plot, std::string_view name) {
    const auto view = CurveView::find(plot, name);
    if (!view) return {};
    return view->all_values(plot);
}

}  // namespace corpuscle::circuit
