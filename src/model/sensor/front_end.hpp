#pragma once
// Sensor and transducer of a front end: from force to the measured value, which is the transducer's output, and back to newtons by a
// calibration.

#include <functional>
#include <limits>
#include <vector>

#include "model/parameter_values.hpp"

namespace corpuscle {

/// One stage of a front end: the sensor, or the transducer after it. The file of each component defines its stage.
struct FrontEndStage {
    std::string_view component;  ///< name of the component: "f2v"
    Probe output;                ///< name and unit of its output
    /// The output for an input, which is the force (N) or the output of the stage before. It never decreases, and is finite for finite
    /// input.
    std::function<double(double)> curve;
    double limit = std::numeric_limits<double>::infinity();  ///< upper limit of the output, in its unit
    std::string_view limit_name = {};                        ///< the parameter that sets the limit
    std::string_view gain_name = {};                         ///< the parameter that messages advise to lower if the limit is exceeded
    double hysteresis = 0;                                   ///< of a sensor, a fraction: see FrontEnd::apply_hysteresis
};

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

/// The sensor and the transducer of a plan; without stages if it has none.
FrontEnd make_front_end(const AfferentPlan&);

/// An afferent behind a front end without a converter. The input of the inner afferent, which can be any, is not the force but the
/// calibrated reading of the sensor, in newtons.
std::unique_ptr<Afferent> make_behind_front_end(FrontEnd, std::unique_ptr<Afferent>);

}  // namespace corpuscle
