#pragma once
// Which parameters are fitted: those that the request names, or all that the data determine.

#include "fit/transistor/data_coverage.hpp"
#include "fit/transistor/transistor_fit.hpp"

namespace corpuscle {

enum class ParameterRole : std::uint8_t { left_out, if_determined, required };

class ParameterChoice {
    const TransistorFitRequest& request_;
    std::vector<FittedCardValue> undetermined_ = {};

public:
    explicit ParameterChoice(const TransistorFitRequest& request) : request_(request) {}

    /// An error if the request names something else.
    Result<void> check_names() const;
    ParameterRole role(std::string_view name, std::string_view card_name, bool is_optional) const;
    ParameterRole role(const CardParameter& p) const { return role(p.name, p.card_name, p.is_optional); }
    ParameterRole role(const MismatchParameter& p) const { return role(p.name, p.card_name, false); }
    /// True if the value is given by the request.
    bool is_given(std::string_view card_name) const;

    /// Takes a parameter out of the fit; an error if it is required. Its value on the card becomes one without effect, unless it is given.
    Result<void> leave_out(const CardParameter&, circuit::UicmCard&, const std::string& reason);
    Result<void> leave_out(const MismatchParameter&, const circuit::UicmCard&, const std::string& reason);
    /// The parameters to fit with these data.
    Result<std::vector<const CardParameter*>> choose(const DataCoverage&, circuit::UicmCard&);

    /// The values that are not fitted because the data do not determine them.
    const std::vector<FittedCardValue>& undetermined() const { return undetermined_; }
};

}  // namespace corpuscle
