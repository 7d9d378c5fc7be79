#pragma once
// Sensor and transducer of a front end: from force to the measured value, which is the transducer's output, and back to newtons by a
// calibration.

#include <vector>

#include "model/sensor/front_end_stage.hpp"

namespace corpuscle {

/// The parameter of every sensor for the calibration: measured values are converted to newtons by a straight line that is exact at zero
/// force and at F_cal.
inline constexpr ParameterInfo calibration_parameter = {
    "F_cal",
    "N",
    4,
    1e-6,
    1e6,
    "force of the calibration, a straight line that is exact at zero force and at F_cal",
    "choice: the top of the press",
    true};

/// Without stages the measured value is the force itself.
class FrontEnd {
    std::vector<FrontEndStage> stages_;
    double F_cal_, at_zero_ = 0, at_cal_ = 1;  // at_zero_, at_cal_: measured values at zero force and at F_cal

public:
    struct SensorReading {
        double value = 0;        ///< output of the last stage; the force in newtons if there are no stages
        bool saturated = false;  ///< true if the output of a stage was limited
    };

    FrontEnd(std::vector<FrontEndStage> stages, double F_cal);
    const std::vector<FrontEndStage>& stages() const { return stages_; }

    /// The force after hysteresis, N, for a new force F and the previous result `last`. If F is above 0, it is `last` limited to
    /// [F, (1 + h) F], otherwise F. This is a relative play operator; h is the sensor's hysteresis.
    double apply_hysteresis(double last, double F) const;
    /// The measured value for a force `sensed`, which is the force after hysteresis, N. If `stage_outputs` is not null, the output of each
    /// stage is written there.
    SensorReading read(double sensed, double* stage_outputs = nullptr) const;
    /// The force that the calibration assigns to a measured value, N.
    double calibrated_force(double value) const { return stages_.empty() ? value : F_cal_ * ((value - at_zero_) / (at_cal_ - at_zero_)); }
    /// The force in [low, high] that gives this measured value, N.
    double inverse(double value, double low, double high) const;
    /// Returns an error if the front end cannot measure forces from `low` to `high` (N): if a stage saturates at `high`, or both give the
    /// same measured value. `name` is the afferent's name, `parameter` the name of the parameter that sets `high`, for the message.
    Result<void> check_range(std::string_view name, double low, std::string_view parameter, double high) const;
};

}  // namespace corpuscle
