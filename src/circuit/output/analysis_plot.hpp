#pragma once
// The result of an analysis: named columns of numbers, as in the result files of SPICE simulators.

#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// A named column of values; the imaginary part of a real value is 0.
struct Curve {
    std::string name;  ///< "v(out)", "i(v1)", "frequency"
    std::string type;  ///< as in ngspice: "voltage", "current", "frequency", "notype" ...
    std::vector<std::complex<double>> values;
};

/// One plot. If `has_sweep` is true, the first curve is the swept quantity, and curves[k + has_sweep] is the k-th other curve.
struct Plot {
    std::string name;  ///< "DC transfer characteristic"
    bool is_complex = false, has_sweep = true;
    std::vector<Curve> curves;

    std::size_t point_count() const { return curves.empty() ? 0 : curves[0].values.size(); }
    /// The curve of this name; null if there is none.
    const Curve* find_curve(std::string_view curve_name) const {
        for (const auto& c : curves)
            if (c.name == curve_name) return &c;
        return nullptr;
    }
};

}  // namespace corpuscle::circuit
