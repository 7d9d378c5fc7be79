#pragma once
// What an analysis finds: columns of numbers with names, as simulators' result files hold them.

#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

struct Curve {
    std::string name;  ///< "v(out)", "i(v1)", "frequency"
    std::string type;  ///< ngspice's word: "voltage", "current", "frequency", "notype" ...
    std::vector<std::complex<double>> values;
};

/// One plot: the first curve is what was swept, if `swept`.
struct Plot {
    std::string name;  ///< "DC transfer characteristic"
    bool is_complex = false, swept = true;
    std::vector<Curve> curves;

    std::size_t points() const { return curves.empty() ? 0 : curves[0].values.size(); }
    /// Null: none of this name.
    const Curve* curve(std::string_view name_) const {
        for (const auto& c : curves)
            if (c.name == name_) return &c;
        return nullptr;
    }
};

}  // namespace corpuscle::circuit
