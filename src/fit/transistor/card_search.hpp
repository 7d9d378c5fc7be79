#pragma once
// The search for a card: least squares, the noise from the residuals, and the standard errors.

#include "fit/transistor/transistor_fit.hpp"

namespace corpuscle {

class CardSearch {
    const IvData& data_;
    const TransistorFitRequest& request_;

    Vector differences(const std::vector<circuit::DrainBulkCurrents>& computed, bool of_bulk, Vector& currents) const;
    void compute_errors();
    bool update_noise(const std::vector<circuit::DrainBulkCurrents>& computed);

public:
    CurveResiduals residuals;
    circuit::UicmCard card = {};
    std::vector<const CardParameter*> fitted = {};
    LeastSquaresFit fit = {};
    Vector errors = {};  ///< standard error of each coordinate

    CardSearch(const IvData&, const TransistorFitRequest&);

    /// Least squares from `card`, and the noise from its residuals, in turns. Then the standard errors.
    void minimize();

    double degrees_of_freedom() const;
    /// The 97.5 % quantile of the error of a coordinate over its standard error, which is uncertain with few points.
    double quantile(std::size_t k) const;
    bool is_at_bound(std::size_t k) const { return fit.x[k] <= fitted[k]->low || fit.x[k] >= fitted[k]->high; }
    /// The parameter that the data determine least, if its standard error is above its resolution. `length`: the smallest L, m.
    std::optional<std::size_t> least_determined(double length) const;
};

}  // namespace corpuscle
