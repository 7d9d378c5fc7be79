#include "fit/transistor/card_search.hpp"

#include <algorithm>
#include <cmath>

#include "fit/transistor/noise_estimate.hpp"

namespace corpuscle {
namespace {

constexpr double least_noise = 1e-3;                      // relative: with less, every model error would seem to determine something
constexpr double first_noise = 0.03, first_floor = 1e-8;  // the first guess, of a current and of the largest current
constexpr int max_noise_passes = 8;

bool is_of_junction(const CardParameter* p) { return p->card_name == "js" || p->card_name == "jssw" || p->card_name == "nj"; }

}  // namespace

CardSearch::CardSearch(const IvData& data, const TransistorFitRequest& request) : data_(data), request_(request), residuals(data) {
    double largest = 0;
    for (const auto& p : data.points) largest = std::max(largest, std::abs(p.I_D));
    auto& noise = residuals.drain_noise;
    noise = {request.relative_noise.value_or(first_noise), request.noise_floor.value_or(first_floor * largest)};
    residuals.bulk_noise = noise;
    std::vector<circuit::DrainBulkCurrents> measured;
    for (const auto& p : data.points) measured.push_back({p.I_D, std::isnan(p.I_B) ? 0 : p.I_B});
    residuals.set_deviations(measured);
}

Vector CardSearch::differences(const std::vector<circuit::DrainBulkCurrents>& computed, bool of_bulk, Vector& currents) const {
    Vector out;
    const auto add = [&](double measured, double I) { out.push_back(measured - I), currents.push_back(I); };
    if (of_bulk)
        for (const auto k : residuals.bulk_points()) add(data_.points[k].I_B, computed[k].I_B);
    else
        for (std::size_t k = 0; k < data_.points.size(); ++k) add(data_.points[k].I_D, computed[k].I_D);
    return out;
}

/// Updates the noise from the residuals. Returns true if it has hardly changed.
bool CardSearch::update_noise(const std::vector<circuit::DrainBulkCurrents>& computed) {
    std::vector<bool> at_bound;
    for (std::size_t k = 0; k < fitted.size(); ++k) at_bound.push_back(is_at_bound(k));
    const auto all = leverages(fit.at.slopes, at_bound);
    const auto drain_points = static_cast<std::ptrdiff_t>(data_.points.size());
    const auto update = [&](CurrentNoise& noise, bool of_bulk) {
        Vector currents;
        const auto r = differences(computed, of_bulk, currents);
        const auto old = noise;
        const Vector of_group = of_bulk ? Vector(all.begin() + drain_points, all.end()) : Vector(all.begin(), all.begin() + drain_points);
        noise = estimate_noise(r, currents, old, request_.relative_noise, request_.noise_floor, of_group);
        return std::abs(noise.relative - old.relative) < 0.01 * noise.relative && std::abs(noise.floor - old.floor) < 0.03 * noise.floor;
    };
    const bool drain = update(residuals.drain_noise, false), bulk = update(residuals.bulk_noise, true);
    return drain && bulk;
}

void CardSearch::minimize() {
    Vector low, high;
    for (const auto* p : fitted) low.push_back(p->low), high.push_back(p->high);
    for (int pass = 0; pass < max_noise_passes; ++pass) {
        const auto base = card;
        fit = least_squares([&](const Vector& x, bool with_slopes) { return residuals.residuals(base, fitted, x, with_slopes); },
                            coordinates_of(card, fitted), low, high);
        card = card_at(card, fitted, fit.x);
        const auto computed = residuals.currents(card);
        const bool is_settled = update_noise(computed);
        residuals.set_deviations(computed);
        if (is_settled) break;
    }
    fit.at = residuals.residuals(card, fitted, fit.x, true);
    fit.cost = dot_product(fit.at.values, fit.at.values);
    compute_errors();
}

double CardSearch::degrees_of_freedom() const {
    return std::max(1.0, static_cast<double>(fit.at.values.size()) - static_cast<double>(fitted.size()));
}

/// From the slopes, widened for neighbouring residuals that are alike, and for residuals above a given noise.
void CardSearch::compute_errors() {
    std::vector<bool> at_bound, none(fitted.size(), false);
    for (std::size_t k = 0; k < fitted.size(); ++k) at_bound.push_back(is_at_bound(k));
    const auto inner = covariance(fit.at.slopes, at_bound), all = covariance(fit.at.slopes, none);
    const double r = neighbour_correlation(data_, fit.at.values), degrees = degrees_of_freedom();
    double factor = (1 + r) / (1 - r);
    if (const double chi = fit.cost / degrees; chi > 1 + 3 * std::sqrt(2 / degrees)) factor *= chi;
    errors.clear();
    for (std::size_t k = 0; k < fitted.size(); ++k)
        errors.push_back(std::sqrt((at_bound[k] ? all : inner)[k * fitted.size() + k] * factor));
}

/// The two numbers of the noise are estimated from the same currents.
double CardSearch::quantile(std::size_t k) const {
    const auto of_junction = static_cast<double>(std::ranges::count_if(fitted, is_of_junction));
    const double points = static_cast<double>(is_of_junction(fitted[k]) ? residuals.bulk_points().size() : data_.points.size());
    const double parameters = is_of_junction(fitted[k]) ? of_junction : static_cast<double>(fitted.size()) - of_junction;
    return student_quantile(points - parameters - (request_.relative_noise ? 0 : 1) - (request_.noise_floor ? 0 : 1));
}

std::optional<std::size_t> CardSearch::least_determined(double length) const {
    const double scale = std::max(1.0, least_noise / std::max(residuals.drain_noise.relative, 1e-12));
    std::optional<std::size_t> worst;
    double largest = 1;
    for (std::size_t k = 0; k < fitted.size(); ++k) {
        const double resolution = fitted[k]->resolution * (fitted[k]->scales_with_length ? length : 1);
        if (const double ratio = errors[k] * scale / resolution; ratio > largest) largest = ratio, worst = k;
    }
    return worst;
}

}  // namespace corpuscle
