#pragma once
// .four: the harmonics of curves of a transient over its last period.

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

/// One harmonic: magnitude * sin(2 pi frequency (t - t0) + phase), where t0 is the beginning of the last period.
struct Harmonic {
    double frequency;  ///< Hz
    double magnitude;  ///< in the unit of the curve
    double phase;      ///< degrees, -180 to 180
};

/// The spectrum of one curve.
struct FourierSpectrum {
    std::string curve;  ///< its name in the .four line
    double frequency;   ///< of the first harmonic, Hz
    double mean;        ///< in the unit of the curve
    std::vector<Harmonic> harmonics;

    /// The total harmonic distortion, %: the root of the sum of squares of all harmonics but the first, over the first.
    double distortion() const;
    /// The name of that number for .expect and .mc: "thd(v(out))".
    std::string distortion_name() const { return "thd(" + curve + ")"; }
    /// A table, as ngspice prints it.
    std::string text() const;
};

/// Computes the mean and nine harmonics of the curves that the .four lines name, point by point. Between points a curve is a straight line,
/// whose integral with a sine is exact.
class FourierTransforms {
    struct Transform {
        const Directive* directive;
        std::string name;
        CurveView view;
        double frequency, from;  // Hz; beginning of the last period, s
        double integral = 0;
        std::vector<std::complex<double>> products{};  // with exp(-2 pi j k f (t - from)), for k = 1, 2 ...
    };
    const Circuit& circuit_;
    std::vector<Transform> transforms_;
    std::vector<double> previous_;  // the last point

public:
    explicit FourierTransforms(const Circuit& circuit) : circuit_(circuit) {}

    /// Begins the plot of a .tran. Appends to `left_out` the reason for each curve that is not available. A misspelt name, and a period
    /// that is longer than the transient, is an error.
    Result<void> begin(const Directive& tran, const Plot& head, std::vector<Error>& left_out);
    void add_point(const PlotRow& row);
    std::vector<FourierSpectrum> spectra() const;
};

}  // namespace corpuscle::circuit
