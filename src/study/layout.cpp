#include "study/layout.hpp"

#include "circuit/cost/area.hpp"

namespace corpuscle {
namespace {

using Rule = circuit::RectangleRule;
constexpr double um = 1e6, apart = 0.8;  // apart: um, of two arrays

/// In um.
void put_rectangle(Line& path, double left, double low, double width, double height) {
    const double x[] = {left, left + width, left + width, left, left, Claim::none};
    const double y[] = {low, low, low + height, low + height, low, Claim::none};
    path.x.insert(path.x.end(), std::begin(x), std::end(x)), path.y.insert(path.y.end(), std::begin(y), std::end(y));
}

/// Channels of W in rows, of L in columns; the array's width.
double put_array(const OurArray& a, double left, Line& channels, Line& total) {
    const auto rows = static_cast<std::size_t>(a.printed->rows), columns = static_cast<std::size_t>(a.printed->columns);
    const double W = um * a.W, pitch = W + um * Rule::between_W;
    double x = left + 0.5 * um * Rule::around_L;
    for (std::size_t column = 0; column < columns; ++column) {
        const double L = um * a.lengths[column * rows];
        for (std::size_t row = 0; row < rows; ++row)
            put_rectangle(channels, x, 0.5 * um * Rule::around_W + static_cast<double>(row) * pitch, L, W);
        x += L + um * Rule::between_L;
    }
    const double width = x - left - um * Rule::between_L + 0.5 * um * Rule::around_L;
    put_rectangle(total, left, 0, width, static_cast<double>(rows) * pitch - um * Rule::between_W + um * Rule::around_W);
    return width;
}

}  // namespace

Plot layout_of(const OurArrays& arrays, std::string title) {
    Plot out{std::move(title), "along the channels, one array beside the other (um)", "across (um)", {}};
    Line channels, total;
    double left = 0;
    for (const auto& a : arrays) left += put_array(a, left, channels, total) + apart;
    return out.add("channels", channels, Plot::Style::path).add("total area", total, Plot::Style::path);
}

}  // namespace corpuscle
