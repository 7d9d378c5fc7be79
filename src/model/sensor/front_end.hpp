#pragma once
// The front end, sensor and transducer together: from force to the measured value, and back to newtons by a calibration.

#include <vector>

#include "model/sensor/front_end_stage.hpp"
#include "signal/parameter.hpp"

namespace corpuscle {

/// The calibration: a straight line through zero force and F_cal.
struct Calibration {
    struct Params {
        double F_cal = 4;
    };
    static constexpr ParameterDef<Params> fields[] = {
        {"F_cal", &Params::F_cal, "N", 1e-6, 1e6, "force at which the chain is calibrated: a straight line through it and zero force",
         "choice: the top of the press", true},
    };
};

class FrontEnd {
    std::vector<FrontEndStage> stages_;
    double F_cal_, at_zero_ = 0, at_cal_ = 1;

public:
    struct SensorReading {
        double value = 0;  ///< output of the last stage; newtons if there is none
        bool saturated = false;
    };

    FrontEnd(std::vector<FrontEndStage> stages, double F_cal);
    const std::vector<FrontEndStage>& stages() const { return stages_; }

    /// The force after hysteresis, N, for a new force F and the previous result `last`: `last`, limited to [F, (1 + h) F] for an F above 0.
    /// This is a relative play operator; h is the sensor's hysteresis.
    double apply_hysteresis(double last, double F) const;
    /// The measured value for a force after hysteresis. If `shown` is given, the output of each stage is written there.
    SensorReading read(double sensed, double* shown = nullptr) const;
    /// The force that the calibration assigns to a measured value; N.
    double calibrated_force(double value) const { return stages_.empty() ? value : F_cal_ * ((value - at_zero_) / (at_cal_ - at_zero_)); }
    /// The force in [low, high] with this measured value; N.
    double inverse(double value, double low, double high) const;
    /// Returns an error for a range of force that the chain cannot measure: its upper end saturates, or both ends give the same value.
    Result<void> check_range(std::string_view name, double low, std::string_view parameter, double high) const;
};

}  // namespace corpuscle
