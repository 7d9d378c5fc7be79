#include "reproduction/texture/texture_task.hpp"

#include <numeric>

#include "core/random.hpp"
#include "reproduction/readout/linear_readout.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t random_choices = 20;

/// A random order of the numbers below `total` (Fisher and Yates).
std::vector<std::size_t> random_order(std::size_t total, std::uint32_t choice) {
    constexpr auto purpose = static_cast<std::uint32_t>(stream_id("taxel choice"));
    std::vector<std::size_t> out(total);
    std::iota(out.begin(), out.end(), std::size_t{0});
    for (std::size_t k = total; k-- > 1;) {
        const auto w = philox({static_cast<std::uint32_t>(k), choice, 0, purpose}, 1);
        std::swap(out[k], out[static_cast<std::size_t>(unit_interval(w[0], w[1]) * static_cast<double>(k + 1))]);
    }
    return out;
}

}  // namespace

std::vector<std::vector<std::size_t>> taxel_choices(std::size_t taxels, std::size_t total) {
    std::vector<std::vector<std::size_t>> out;
    const std::size_t choices = taxels == 1 ? total : taxels == total ? 1 : random_choices;
    for (std::size_t k = 0; k < choices; ++k) {
        auto order = random_order(total, static_cast<std::uint32_t>(k));
        if (taxels == 1) order = {k};
        order.resize(taxels);
        out.push_back(std::move(order));
    }
    return out;
}

double TextureTask::mean(const std::string& name) const {
    double sum = 0, n = 0;
    for (const auto& trial : features_.at(name))
        for (const double x : trial) sum += x, n += 1;
    return sum / n;
}

std::size_t TextureTask::tested(SlideTest test) const {
    std::size_t out = 0;
    for (const auto& split : slide_splits(trials_, test)) out += split.tested.size();
    return out;
}

Accuracy TextureTask::accuracy(const std::vector<std::string>& features, SlideTest test, std::size_t taxels) const {
    const auto splits = slide_splits(trials_, test);
    const auto choices = taxel_choices(taxels, features_.at(features.front()).front().size());
    std::vector<double> correct(trials_.size());
    for (const auto& choice : choices) {
        std::vector<ReadoutTrial> readout;
        for (std::size_t k = 0; k < trials_.size(); ++k) {
            readout.push_back({{}, trials_[k].surface});
            for (const auto& name : features)
                for (const auto c : choice) readout.back().features.push_back(features_.at(name)[k][c]);
        }
        for (const auto& split : splits) {
            std::vector<const ReadoutTrial*> learned, tested;
            for (const auto k : split.learned) learned.push_back(&readout[k]);
            for (const auto k : split.tested) tested.push_back(&readout[k]);
            const auto is_correct = read_correctly(learned, tested);
            for (std::size_t k = 0; k < tested.size(); ++k) correct[split.tested[k]] += is_correct[k] / static_cast<double>(choices.size());
        }
    }
    std::vector<double> of_tested;
    std::vector<std::size_t> group;
    for (const auto& split : splits)
        for (const auto k : split.tested) of_tested.push_back(correct[k]), group.push_back(trials_[k].passage());
    return accuracy_interval(of_tested, group);
}

}  // namespace corpuscle
