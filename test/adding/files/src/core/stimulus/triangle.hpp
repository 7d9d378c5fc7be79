#pragma once

#include <vector>

#include "core/force_source.hpp"
#include "core/parameter.hpp"

namespace corpuscle {

/// Force that rises to F_max at a constant rate and falls back to 0.
struct Triangle {
    struct Params {
        double F_max = 1, duration = 1;
    };
    static constexpr std::string_view name = "triangle", description = "force that rises and falls at a constant rate", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_max", &Params::F_max, "N", 0, 1e3, "highest force"},
        {"duration", &Params::duration, "s", 1e-3, 1e6, "duration"},
    };
    Params p;
    double duration() const { return p.duration; }
    std::vector<Phase> phases() const { return {}; }
    double at(double t) const { return 2 * p.F_max * (t < p.duration / 2 ? t : p.duration - t) / p.duration; }
};

}  // namespace corpuscle
