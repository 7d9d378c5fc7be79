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

/// True if the text is more than a name or a call with names: v(a)-v(b), abs(v(a)).
bool has_operator(std::string_view text) {
    int depth = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        depth += text[k] == '(' ? 1 : text[k] == ')' ? -1 : 0;
        const bool is_call_of_call = depth == 2;
        const bool is_minus = text[k] == '-' && depth == 0 && text.find('(') != std::string_view::npos;
        if (is_call_of_call || is_minus || (depth == 0 && std::string_view("+*/^?<>").find(text[k]) != std::string_view::npos)) return true;
    }
    return text.starts_with('(');
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

std::complex<double> CurveView::evaluate_expression(const PlotRow& row) const {
    if (is_complex_expression_) {
        std::vector<std::complex<double>> values;
        for (const auto& input : inputs_) values.push_back(input.value(row));
        return expression_->complex_value(values);
    }
    constexpr std::size_t max_on_stack = 8;
    double on_stack[max_on_stack];
    std::vector<double> on_heap(inputs_.size() > max_on_stack ? inputs_.size() : 0);
    const std::span<double> values = on_heap.empty() ? std::span(on_stack, inputs_.size()) : std::span(on_heap);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = inputs_[k].value(row).real();
    return expression_->value(values);
}

std::optional<std::string_view> curve_expression_text(std::string_view name) {
    const auto is_enclosed = [&](char open, char close) { return name.size() > 2 && name.front() == open && name.back() == close; };
    const bool is_par = name.starts_with("par(") && name.ends_with(')');
    if (is_par) name = name.substr(4, name.size() - 5);
    if (!is_par && name.starts_with("('") && name.ends_with("')")) name = name.substr(1, name.size() - 2);
    if (is_enclosed('{', '}') || is_enclosed('\'', '\'')) return name.substr(1, name.size() - 2);
    return is_par || has_operator(name) ? std::optional(name) : std::nullopt;
}

ExpressionScope curve_scope() {
    ExpressionScope scope;
    scope.allows_inputs = scope.allows_parts = true;
    return scope;
}

std::string curve_name(const ExpressionInput& input) {
    using Kind = ExpressionInput::Kind;
    if (input.kind == Kind::time || input.kind == Kind::temperature) return input.kind == Kind::time ? "time" : "temper";
    if (input.kind == Kind::frequency) return "frequency";
    const auto second = input.minus.empty() ? "" : "," + input.minus;
    return fmt::format("{}{}({}{})", input.kind == Kind::voltage ? 'v' : 'i', input.part, input.name.empty() ? "0" : input.name, second);
}

std::optional<CurveView> CurveView::of_expression(const Plot& plot, Expression expression, const CurveIndex* index) {
    CurveView out;
    for (const auto& input : expression.inputs()) {
        const bool is_part = input.kind == ExpressionInput::Kind::part;
        out.is_complex_expression_ |= plot.is_complex && input.part.empty() && input.kind != ExpressionInput::Kind::frequency;
        auto found = is_part ? of_expression(plot, *input.of, index) : find_named(plot, curve_name(input), index);
        if (!found) return {};
        if (is_part) found->part_ = input.part, found->is_complex_value_ = false;
        out.inputs_.push_back(std::move(*found));
    }
    if (out.is_complex_expression_ && !expression.is_rational()) return {};
    out.is_complex_value_ = out.is_complex_expression_;
    out.expression_ = std::make_shared<const Expression>(std::move(expression));
    return out;
}

std::optional<CurveView> CurveView::find(const Plot& plot, std::string_view name, const CurveIndex* index) {
    if (const auto found = find_named(plot, name, index)) return found;
    if (const auto text = curve_expression_text(name)) {
        auto expression = Expression::parse(*text, {}, curve_scope());
        return expression ? of_expression(plot, std::move(*expression), index) : std::nullopt;
    }
    if (name.find(':') != std::string_view::npos) {
        std::string with_dots(name);
        std::ranges::replace(with_dots, ':', '.');
        return find(plot, with_dots, index);
    }
    if (name.starts_with("n(") && name.ends_with("_branch)"))
        return find_named(plot, fmt::format("i({})", name.substr(2, name.size() - 10)), index);
    if (name.ends_with("#branch")) return find_named(plot, fmt::format("i({})", name.substr(0, name.size() - 7)), index);
    const bool is_word = !name.empty() && name.find_first_of("(){}'@") == std::string_view::npos;
    return is_word ? find_named(plot, fmt::format("v({})", name), index) : std::nullopt;
}

std::optional<CurveView> CurveView::find_named(const Plot& plot, std::string_view name, const CurveIndex* index) {
    CurveView out;
    for (const std::string_view noise : {"onoise", "inoise"})
        if (name == noise || name == fmt::format("v({})", noise)) {
            out.plus_ = index_of(plot, fmt::format("{}_spectrum", noise), index);
            if (out.plus_ >= 0) return out;
        }
    const auto open = name.find('(');
    out.is_complex_value_ = open <= 1;
    out.plus_ = index_of(plot, name, index);
    if (out.plus_ < 0 && (name == "freq" || name == "hertz")) out.plus_ = index_of(plot, "frequency", index);
    if (out.plus_ >= 0) return out;
    if (open == std::string_view::npos || !name.ends_with(')') || (name[0] != 'v' && name[0] != 'i')) return {};
    const auto* part = std::find(std::begin(part_names), std::end(part_names), name.substr(1, open - 1));
    if (part == std::end(part_names)) return {};
    out.part_ = *part;
    const auto inside = name.substr(open + 1, name.size() - open - 2);
    const auto comma = inside.find(',');
    const auto find_curve = [&](std::string_view node, int& curve) {
        if (is_ground(node)) return true;
        curve = index_of(plot, std::string(1, name[0]) + "(" + std::string(node) + ")", index);
        return curve >= 0;
    };
    if (!find_curve(inside.substr(0, comma), out.plus_)) return {};
    if (comma != std::string_view::npos && !find_curve(inside.substr(comma + 1), out.minus_)) return {};
    return out;
}

std::optional<std::vector<std::complex<double>>> find_curve_values(const Plot& plot, std::string_view name) {
    const auto view = CurveView::find(plot, name);
    if (!view) return {};
    std::vector<std::complex<double>> out;
    PlotPoints points(plot);
    for (std::size_t k = 0; k < plot.point_count(); ++k) out.push_back(view->value(points[k]));
    return out;
}

Result<void> PlotPoints::send_to(PointSink& sink, const std::function<void(std::size_t)>& prepare) {
    Plot head = plot_;
    for (auto& c : head.curves) c.values.clear();
    TRY(sink.begin(head));
    for (std::size_t k = 0; k < plot_.point_count(); ++k) {
        if (prepare) prepare(k);
        TRY(sink.add_point((*this)[k]));
    }
    return sink.end();
}

Result<void> CurveSelector::begin(const Plot& plot) {
    Plot head{plot.name, plot.is_complex, plot.has_sweep, {}};
    has_sweep_ = plot.has_sweep && !plot.curves.empty();
    if (has_sweep_) head.curves.push_back({plot.curves[0].name, plot.curves[0].type, {}});
    const CurveIndex index(plot);
    views_.clear();
    for (const auto& name : names_)
        if (const auto view = CurveView::find(plot, name, &index)) {
            views_.push_back(*view);
            head.curves.push_back({name, name[0] == 'v' ? "voltage" : "current", {}});
        }
    return sink_.begin(views_.empty() ? plot : head);
}

Result<void> CurveSelector::add_point(const PlotRow& row) {
    if (views_.empty()) return sink_.add_point(row);
    row_.clear(), complex_row_.clear();
    const auto add = [&](std::complex<double> x) { row.is_complex() ? complex_row_.push_back(x) : row_.push_back(x.real()); };
    if (has_sweep_) add(row[0]);
    for (const auto& view : views_) add(view.value(row));
    return sink_.add_point(row.is_complex() ? PlotRow(complex_row_) : PlotRow(row_));
}

Plot select_curves(const Plot& plot, const std::vector<std::string>& names) {
    PlotRecorder recorder;
    CurveSelector selector(names, recorder);
    (void)PlotPoints(plot).send_to(selector);  // a recorder does not fail
    return std::move(recorder.plot);
}

}  // namespace corpuscle::circuit
