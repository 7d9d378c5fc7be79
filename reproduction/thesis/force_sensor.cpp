#include "reproduction/thesis/force_sensor.hpp"

#include "model/sensor/fsr.hpp"

namespace corpuscle {

double sensor_conductance(double gf) {
    const ParameterValues<Fsr> defaults;
    return Fsr::conductance(defaults, gf * gram_force);
}

double sensor_slope(double gf) {
    const double step = 1e-4 * gf;  // of a central difference: its relative error is about 1e-9
    return (sensor_conductance(gf + step) - sensor_conductance(gf - step)) / (2 * step);
}

}  // namespace corpuscle
