#include "fit/transistor/transistor_fit.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "fit/transistor/card_search.hpp"
#include "fit/transistor/curve_misfit.hpp"
#include "fit/transistor/mismatch_fit.hpp"
#include "fit/transistor/parameter_choice.hpp"
#include "fit/transistor/start_values.hpp"

namespace corpuscle {
namespace {

using circuit::UicmCard;

constexpr int max_mismatch_passes = 3;

class TransistorFitter {
    const IvData& data_;
    const TransistorFitRequest& request_;
    ParameterChoice choice_;
    CardSearch search_;
    DataCoverage coverage_ = {};
    std::vector<FittedCardValue> mismatch_ = {};
    double common_V_T_ = 0, common_log_I_S_ = 0;  // half the 95 % interval of the mean deviation of all devices
    bool has_shifts_ = false;

    Result<void> fit_card() {
        search_.minimize();
        while (const auto worst = search_.least_determined(coverage_.least_length)) {
            const auto* p = search_.fitted[*worst];
            search_.fitted.erase(search_.fitted.begin() + static_cast<std::ptrdiff_t>(*worst));
            const auto reason = fmt::format("the currents hardly depend on it; {}", better_data(p->card_name));
            TRY(choice_.leave_out(*p, search_.card, reason));
            if (search_.fitted.empty())
                return bad_input("these data determine no parameter; measure a sweep of V_G from weak to strong inversion");
            search_.minimize();
        }
        return {};
    }

    bool is_fitted(std::string_view card_name) const { return choice_.role(*find_card_parameter(card_name)) != ParameterRole::left_out; }

    /// Fits the deviations of many devices, and the card to what remains.
    Result<void> fit_mismatch() {
        Vector areas;
        for (const auto& d : data_.devices) areas.push_back(d.W * d.L);
        PelgromCoefficient A_VT, A_K;
        has_shifts_ = true;
        for (int pass = 0; pass < max_mismatch_passes; ++pass) {
            const auto deviations = fit_deviations(search_.residuals, search_.card, data_.devices.size());
            A_VT = pelgrom_coefficient(deviations.V_T, deviations.V_T_error, areas);
            A_K = pelgrom_coefficient(deviations.log_I_S, deviations.log_I_S_error, areas);
            for (std::size_t d = 0; d < data_.devices.size(); ++d)
                search_.residuals.shifts[d] = {deviations.V_T[d] - A_VT.mean, deviations.log_I_S[d] - A_K.mean};
            if (is_fitted("vto")) search_.card.V_T0 += A_VT.mean;
            if (is_fitted("isq")) search_.card.I_SQ *= num::exp(A_K.mean);
            search_.minimize();
        }
        common_V_T_ = A_VT.mean_half_width, common_log_I_S_ = A_K.mean_half_width;
        const PelgromCoefficient* found[] = {&A_VT, &A_K};
        for (std::size_t k = 0; k < 2; ++k) {
            const auto& m = mismatch_parameters()[k];
            if (choice_.role(m) == ParameterRole::left_out) continue;
            search_.card.*m.member = found[k]->value;
            mismatch_.push_back({.name = std::string(m.name),
                                 .card_name = std::string(m.card_name),
                                 .unit = std::string(m.unit),
                                 .value = found[k]->value,
                                 .low = found[k]->low,
                                 .high = found[k]->high,
                                 .is_fitted = true});
        }
        return {};
    }

    FittedCardValue fitted_value(std::size_t k) const {
        const auto& p = *search_.fitted[k];
        FittedCardValue out{.name = std::string(p.name),
                            .card_name = std::string(p.card_name),
                            .unit = std::string(p.unit),
                            .value = search_.card.*p.member,
                            .is_fitted = true,
                            .is_at_bound = search_.is_at_bound(k)};
        const double common = p.card_name == "vto" ? common_V_T_ : p.card_name == "isq" ? common_log_I_S_ : 0;
        const double noise = search_.quantile(k) * search_.errors[k], half = std::sqrt(noise * noise + common * common);
        const auto at = [&](double x) { return value_of_coordinate(p, std::clamp(x, p.low, p.high)); };
        const double a = at(search_.fit.x[k] - half), b = at(search_.fit.x[k] + half);
        out.low = std::min(a, b), out.high = std::max(a, b);
        if (p.card_name == "isq" && !data_.is_geometry_known) out.reason = missing_data(coverage_, "isq");
        return out;
    }

    /// All values in the order of the catalogue.
    std::vector<FittedCardValue> values() const {
        std::vector<FittedCardValue> all = mismatch_, out;
        for (std::size_t k = 0; k < search_.fitted.size(); ++k) all.push_back(fitted_value(k));
        all.insert(all.end(), choice_.undetermined().begin(), choice_.undetermined().end());
        for (const auto& p : card_parameters())
            if (choice_.is_given(p.card_name))
                all.push_back({.name = std::string(p.name),
                               .card_name = std::string(p.card_name),
                               .unit = std::string(p.unit),
                               .value = search_.card.*p.member,
                               .is_given = true});
        const auto add = [&](std::string_view card_name) {
            std::ranges::copy_if(all, std::back_inserter(out), [&](const FittedCardValue& v) { return v.card_name == card_name; });
        };
        for (const auto& p : card_parameters()) add(p.card_name);
        for (const auto& m : mismatch_parameters()) add(m.card_name);
        return out;
    }

    /// The values from which the search begins.
    UicmCard first_card() const {
        auto card = start_values(data_, search_.residuals, request_.base);
        // A search by a logarithm cannot begin at 0, and at 0 the slope along gamma is not defined.
        if (is_fitted("js") && card.J_S == 0) card.J_S = 1e-6;
        if (is_fitted("jssw") && card.J_SSW == 0) card.J_SSW = 1e-12;
        if (is_fitted("gamma") && card.gamma == 0) card.gamma = 0.3;
        if (card.sigma_L == 0) card.sigma_L = 1e-9;
        if (card.zeta_L == 0) card.zeta_L = 5e-9;
        for (const auto& p : card_parameters())
            if (choice_.role(p) == ParameterRole::left_out) card.*p.member = request_.base.*p.member;
        return card;
    }

public:
    TransistorFitter(const IvData& data, const TransistorFitRequest& request)
        : data_(data), request_(request), choice_(request), search_(data, request) {}

    Result<TransistorFit> run() {
        TRY(choice_.check_names());
        search_.card = first_card();
        coverage_ = coverage_of(data_, search_.residuals, search_.card);
        search_.fitted = TRY(choice_.choose(coverage_, search_.card));
        TRY(fit_card());
        if (coverage_.devices >= min_devices) TRY(fit_mismatch());
        TransistorFit out;
        out.card = search_.card, out.is_pmos = data_.is_pmos, out.is_geometry_known = data_.is_geometry_known;
        out.is_converged = search_.fit.is_converged, out.values = values();
        out.drain_noise = search_.residuals.drain_noise, out.bulk_noise = search_.residuals.bulk_noise;
        out.currents = search_.residuals.currents(search_.card);
        if (has_shifts_) out.shifts = search_.residuals.shifts;
        out.misfit = curve_misfit(data_, out.currents, search_.residuals);
        if (request_.relative_noise) out.misfit.chi_squared = search_.fit.cost / search_.degrees_of_freedom();
        out.notes = data_.notes;
        return out;
    }
};

}  // namespace

Result<TransistorFit> fit_transistor(const IvData& data, const TransistorFitRequest& request) {
    return TransistorFitter(data, request).run();
}

}  // namespace corpuscle
