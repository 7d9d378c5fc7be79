#pragma once
// Fits a UICM card to I-V curves.

#include "fit/iv/iv_data.hpp"
#include "fit/transistor/curve_residuals.hpp"

namespace corpuscle {

struct TransistorFitRequest {
    circuit::UicmCard base;          ///< values of what is not fitted
    std::vector<std::string> fit;    ///< names; empty: all that the data determine. "all" stands for these beside other names
    std::vector<std::string> given;  ///< names on the card whose value in the base the user has given
    std::optional<double> relative_noise, noise_floor;  ///< -, A; nullopt: estimated
};

struct FittedCardValue {
    std::string name, card_name, unit;
    double value = 0;
    std::optional<double> low = {}, high = {};  ///< 95 % interval, if it was fitted
    bool is_fitted = false, is_at_bound = false, is_given = false;
    std::string reason = {};  ///< why it is not determined, and which data would tell it
};

/// How well a card explains the points. Relative numbers are over the points whose drain current is above 10 times the noise floor.
struct CurveMisfit {
    std::size_t points = 0;
    double rms = 0, largest = 0;        ///< relative difference of drain currents
    double scatter = 0;                 ///< part of it that differs between neighbouring points: noise
    std::optional<double> gm_over_ID;   ///< rms relative error of g_m/I_D along sweeps of V_G
    std::optional<double> bulk_rms;     ///< relative, of bulk currents
    std::optional<double> chi_squared;  ///< per degree of freedom, if the noise was given
};

struct TransistorFit {
    circuit::UicmCard card;
    bool is_pmos = false, is_geometry_known = true, is_converged = true;
    std::vector<FittedCardValue> values;
    CurrentNoise drain_noise, bulk_noise;
    CurveMisfit misfit;
    std::vector<DeviceShift> shifts;                   ///< of each device; empty: not fitted
    std::vector<circuit::DrainBulkCurrents> currents;  ///< of the card, with the shifts, at each point
    std::vector<std::string> notes;
};

/// An error if a parameter is named in `request.fit` that the data do not determine.
Result<TransistorFit> fit_transistor(const IvData&, const TransistorFitRequest&);

}  // namespace corpuscle
