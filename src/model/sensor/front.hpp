#pragma once
// Sensor and transducer together: from force to what is measured, and back to newtons as a calibration would have it.

#include <vector>

#include "model/sensor/stage.hpp"
#include "signal/field.hpp"

namespace corpuscle {

/// The calibration: a straight line through no force and F_cal.
struct Calibration {
    struct Params {
        double F_cal = 4;
    };
    static constexpr Field<Params> fields[] = {
        {"F_cal", &Params::F_cal, "N", 1e-6, 1e6, "force at which the chain is calibrated: a straight line through it and no force",
         "choice: the top of the press", true},
    };
};

class Front {
    std::vector<Stage> stages_;
    double F_cal_, at_zero_ = 0, at_cal_ = 1;

public:
    struct Reading {
        double value = 0;  ///< of the last stage; newtons if there is none
        bool clipped = false;
    };

    Front(std::vector<Stage> stages, double F_cal);
    const std::vector<Stage>& stages() const { return stages_; }

    /// The force as the sensor feels it, after it last felt `held`: a relative play, hysteresis h between F and (1 + h) F.
    double played(double held, double F) const;
    /// What a felt force is measured as; if `shown` is given, what left each stage is put there.
    Reading read(double felt, double* shown = nullptr) const;
    /// A measured value as the calibration reads it; N.
    double believed(double value) const { return stages_.empty() ? value : F_cal_ * ((value - at_zero_) / (at_cal_ - at_zero_)); }
    /// The force in [low, high] that is measured as this; N.
    double inverse(double value, double low, double high) const;
    /// Refuses a range of forces that the chain must measure and cannot: its top is clipped, or not told from its bottom.
    std::optional<Error> unreadable(std::string_view of, double low, std::string_view name, double high) const;
};

}  // namespace corpuscle
