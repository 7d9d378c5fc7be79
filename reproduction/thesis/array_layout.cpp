#include "reproduction/thesis/array_layout.hpp"

#include <fmt/format.h>
#include <numeric>

#include "circuit/cost/area.hpp"

namespace corpuscle {
namespace {

using Rule = circuit::RectangleRule;
constexpr double um = 1e6;                  // um per m
constexpr double gap_between_arrays = 0.8;  // um; chosen for the drawing

/// Appends a rectangle (um) to a path; NaN separates it from the next one.
void append_rectangle(StudyCurve& path, double left, double bottom, double width, double height) {
    const double x[] = {left, left + width, left + width, left, left, Claim::none};
    const double y[] = {bottom, bottom, bottom + height, bottom + height, bottom, Claim::none};
    path.x.insert(path.x.end(), std::begin(x), std::end(x)), path.y.insert(path.y.end(), std::begin(y), std::end(y));
}

/// Appends the array's channels and its total area, with the left edge at `left` (um). Its columns follow one another along x, in the
/// direction of L; its rows along y, in the direction of W. They are columns and rows of the drawing only: either may be in series or in
/// parallel. Returns the width of the total area (um).
double append_array(const SimulatedArray& a, double left, StudyCurve& channels, StudyCurve& total) {
    const auto rows = static_cast<std::size_t>(a.published->rows), columns = static_cast<std::size_t>(a.published->columns);
    const double W = um * a.W, pitch = W + um * Rule::between_W;
    double x = left + 0.5 * um * Rule::around_L;
    for (std::size_t column = 0; column < columns; ++column) {
        const double L = um * a.lengths[column * rows];  // only F has different lengths; it has one row
        for (std::size_t row = 0; row < rows; ++row)
            append_rectangle(channels, x, 0.5 * um * Rule::around_W + static_cast<double>(row) * pitch, L, W);
        x += L + um * Rule::between_L;
    }
    const double width = x - left - um * Rule::between_L + 0.5 * um * Rule::around_L;
    append_rectangle(total, left, 0, width, static_cast<double>(rows) * pitch - um * Rule::between_W + um * Rule::around_W);
    return width;
}

}  // namespace

StudyPlot layout_plot(const SimulatedArrays& arrays, std::string title) {
    StudyPlot out{std::move(title), "along L, arrays side by side (um)", "along W (um)", {}};
    StudyCurve channels, total;
    double left = 0;
    for (const auto& a : arrays) left += append_array(a, left, channels, total) + gap_between_arrays;
    return out.add("channels", channels, StudyPlot::Style::path).add("total area", total, StudyPlot::Style::path);
}

Result<StudyResult> report_layout(const PublishedArrays& tables, const std::string& figure, const std::string& remark) {
    const auto ours = TRY(simulate_arrays(tables));
    StudyResult out;
    double published_sum = 0, sum = 0;
    std::string names;
    for (const auto& a : ours) {
        out.claim(fmt::format("{}: total area", a.published->name), 1e12 * a.A_T, "um^2")
            .published_as(a.published->A_T, fmt::format("{}, of the arrays in {}", tables.sizes_table, figure));
        out.claim(fmt::format("{}: active area from its channels", a.published->name),
                  1e12 * a.W * std::accumulate(a.lengths.begin(), a.lengths.end(), 0.0), "um^2")
            .published_as(a.published->A, tables.sizes_table);
        published_sum += a.published->A_T, sum += 1e12 * a.A_T;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", a.published->name);
    }
    out.claim("sum of all total areas", sum, "um^2").derived_as(published_sum, tables.sizes_table);
    out.plots.push_back(layout_plot(ours, fmt::format("Channels and total areas of {}, from the left", names))
                            .describe_published("polysilicon and diffusion of each array in its rectangle; the original figure is lost"));
    out.note(
        "The numbers of rows and columns are those that reproduce the published total areas; one rule gives the margins and spacings of "
        "all channels. " +
        remark);
    return out;
}

}  // namespace corpuscle
