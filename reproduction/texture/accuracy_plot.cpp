#include "reproduction/texture/accuracy_plot.hpp"

namespace corpuscle {

void BarCurve::add(double x, const Accuracy& a) {
    for (const double y : {a.mean, a.low, a.high, a.mean}) curve_.x.push_back(x), curve_.y.push_back(100 * y);
}

void BarCurve::add_to(StudyPlot& plot, std::string name) && { plot.add(std::move(name), std::move(curve_), StudyPlot::Style::path); }

void add_chance(StudyPlot& plot, double chance, double from, double to) {
    plot.add("chance", {{from, to}, {100 * chance, 100 * chance}}, StudyPlot::Style::path);
}

void plot_over_taxels(StudyResult& out, std::string title, const TextureTask& task, SlideTest test,
                      const std::vector<TextureReader>& readers, std::size_t most, double chance) {
    auto& plot = out.plot(std::move(title), "taxels, each with one afferent of each kind", "accuracy (%)", true);
    double shift = 1;
    for (const auto& r : readers) {
        BarCurve curve;
        for (std::size_t n = 1; n <= most; n *= 2) curve.add(static_cast<double>(n) * shift, task.accuracy(r.features, test, n));
        std::move(curve).add_to(plot, r.name), shift *= 1.04;
    }
    add_chance(plot, chance, 1, static_cast<double>(most));
}

}  // namespace corpuscle
