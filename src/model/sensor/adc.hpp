#pragma once

#include "model/sensor/front_end.hpp"

namespace corpuscle {

/// An analog-to-digital converter, and the word format of the fixed-point algorithms behind it (doc/fixed-point.md):
///
///     code = floor((y - y_low) / D + 1/2) within [0, 2^bits - 1],   D = (y_high - y_low) / (2^bits - 1)
///
/// y is the output of sensor and transducer, D the step of y between two codes. y_low and y_high are the outputs at the forces F_low and
/// F_high, so the range of the converter is given in newtons for every transducer. The converter is ideal: no noise, no aperture, no
/// settling. All default values are our choice.
struct Adc {
    static constexpr std::string_view name = "adc",
                                      description = "analog-to-digital converter; the algorithms behind it run in fixed point";
    static constexpr std::string_view source = "thesis 1.3, fig. 6a; all values are a choice";
    static constexpr ParameterInfo parameters[] = {
        {"bits", "", 12, 1, 16, "bits of a code", {}, true},
        {"f_s", "Hz", 1e3, 0.1, 1e6, "conversions per second; each is one step of the algorithms", {}, true},
        {"F_low", "N", 0, -1e6, 1e6, "force of the lowest code"},
        {"F_high", "N", 5, -1e6, 1e6, "force of the highest code"},
        {"shared",
         "",
         0,
         0,
         1,
         "1: one converter samples all channels in turn, channel c (from 0) of N delayed by c/(N f_s). 0: one converter per channel",
         {},
         true},
        {"linearise",
         "",
         1,
         0,
         1,
         "1: a table from code to force inverts the curve of sensor and transducer. 0: the calibration's straight line",
         {},
         true},
        {"word", "", 32, 8, 32, "bits of a word in the algorithms", {}, true},
        {"frac", "", 20, 0, 31, "fraction bits of a word: steps of 2^-frac N, uA, V", {}, true},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"F_low", "F_high"},
        {"frac", "word"},
    };
    /// Parameters that must be integers.
    static constexpr std::string_view integers[] = {"bits", "shared", "linearise", "word", "frac"};
};

/// Converts force to codes by the front end and the converter, and codes back to force.
class Converter {
    FrontEnd front_end_;
    ParameterValues<Adc> value_;
    double low_, high_, max_code_;  // low_, high_: y_low and y_high above

public:
    struct QuantizedCode {
        std::int64_t code = 0;
        bool saturated = false;  ///< true if the transducer is at its limit, or the code would be outside its range
    };

    Converter(FrontEnd front, const ParameterValues<Adc>& value)
        : front_end_(std::move(front)), value_(value), low_(front_end_.read(value("F_low")).value),
          high_(front_end_.read(value("F_high")).value), max_code_(std::exp2(value("bits")) - 1) {}

    const FrontEnd& front_end() const { return front_end_; }
    std::int64_t max_code() const { return static_cast<std::int64_t>(max_code_); }

    /// The code of a force after the sensor's hysteresis, N.
    QuantizedCode convert(double sensed) const {
        const auto reading = front_end_.read(sensed);
        const double unlimited = std::floor((reading.value - low_) / (high_ - low_) * max_code_ + 0.5);
        if (unlimited < 0) return {0, true};
        if (unlimited > max_code_) return {max_code(), true};
        return {static_cast<std::int64_t>(unlimited), reading.saturated};
    }

    /// The force that a code represents, N. If `linearise` is 1, it is found by inverting the curve of sensor and transducer, otherwise by
    /// the calibration's straight line.
    double force(std::int64_t code) const {
        const double fraction = static_cast<double>(code) / max_code_;
        if (value_("linearise") == 0) return front_end_.calibrated_force(low_ + fraction * (high_ - low_));
        if (front_end_.stages().empty() || code == 0 || code == max_code())
            return value_("F_low") + fraction * (value_("F_high") - value_("F_low"));
        return front_end_.inverse(low_ + fraction * (high_ - low_), value_("F_low"), value_("F_high"));
    }
};

}  // namespace corpuscle
