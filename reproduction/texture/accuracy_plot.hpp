#pragma once
// Plots of accuracies with their intervals.

#include "reproduction/claims/study.hpp"
#include "reproduction/texture/texture_surfaces.hpp"

namespace corpuscle {

/// A curve with a vertical bar, the 95 % interval, at each point. Accuracies are in percent.
class BarCurve {
    StudyCurve curve_;

public:
    void add(double x, const Accuracy&);
    /// Adds the curve to a plot as a path.
    void add_to(StudyPlot&, std::string name) &&;
};

/// Adds a horizontal line at the accuracy of a guess.
void add_chance(StudyPlot&, double chance, double from, double to);

/// Plots the accuracy of read-outs over the number of taxels: 1, 2, 4 ... `most`. The curves are drawn a little apart, so that their bars
/// can be seen.
void plot_over_taxels(StudyResult&, std::string title, const TextureTask&, SlideTest, const std::vector<TextureReader>&, std::size_t most,
                      double chance);

}  // namespace corpuscle
