// The cases of an optimization: all combinations of its conditions, then its chips.

#include <fmt/format.h>

#include "core/text/quantity.hpp"
#include "optimize/problem_text.hpp"

namespace corpuscle::optimize {
namespace {

/// The axes of the conditions follow those of the variables.
std::span<const sweeps::SweepAxis> condition_axes(const ProblemText& text, const sweeps::SweepPlan& plan) {
    std::size_t first = 0;
    for (const auto& names : text.names) first += names.size();
    return std::span(plan.axes).subspan(first, text.conditions().size());
}

std::string condition_text(const sweeps::SweepAxis& axis, double value) {
    const auto& c = axis.column;
    return fmt::format("{}={}", c.name,
                       c.labels.empty() ? c.unit == "degC" ? fmt::format("{:g}", value) : format_quantity(value, c.unit)
                                        : c.labels[static_cast<std::size_t>(value)]);
}

}  // namespace

Result<std::vector<DesignCase>> make_cases(const ProblemText& text, const sweeps::SweepPlan& plan) {
    const auto axes = condition_axes(text, plan);
    std::vector<DesignCase> out;
    double count = 1;
    std::vector<std::size_t> sizes;
    for (std::size_t k = 0; k < axes.size(); ++k) {
        sizes.push_back(axes[k].values.size() - (text.chip_settings[k].is_scalar() ? 1 : 0));
        count *= static_cast<double>(sizes[k]);
    }
    if (count + static_cast<double>(text.chips) > static_cast<double>(max_cases))
        return bad_input(fmt::format("{:g} conditions and {:g} chips are more than the limit of {} cases; shorten the lists of [[at]]",
                                     count, static_cast<double>(text.chips), max_cases),
                         {text.file()});
    for (std::size_t number = 0; number < static_cast<std::size_t>(count); ++number) {
        auto& c = out.emplace_back();
        std::size_t rest = number;
        c.values.resize(axes.size());
        for (std::size_t k = axes.size(); k-- > 0; rest /= sizes[k]) c.values[k] = axes[k].values[rest % sizes[k]];
        if (axes.empty()) c.text = "the only condition";
        for (std::size_t k = 0; k < axes.size(); ++k) c.text += (k ? " " : "") + condition_text(axes[k], c.values[k]);
    }
    for (std::uint64_t chip = 0; chip < text.chips; ++chip) {
        auto& c = out.emplace_back();
        c.chip = chip, c.text = fmt::format("chip {}", chip + 1);
        for (std::size_t k = 0; k < axes.size(); ++k)
            c.values.push_back(text.chip_settings[k].is_scalar() ? axes[k].values.back() : axes[k].values.front());
    }
    return out;
}

}  // namespace corpuscle::optimize
