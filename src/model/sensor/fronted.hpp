#pragma once
// An afferent behind a sensor: it answers not the force but what the sensor's calibration makes of it. Any afferent, unchanged.

#include <memory>

#include "model/sensor/front.hpp"

namespace corpuscle {

class Fronted final : public Afferent {
    Front front_;
    std::unique_ptr<Afferent> inner_;
    std::string name_, inner_format_, format_;
    std::vector<Probe> probes_;  // the front's, the force as believed, the inner afferent's
    std::size_t inner_values_;

    std::vector<double> believed(std::span<const double> force, State&, Answer&) const;

public:
    Fronted(Front, std::unique_ptr<Afferent>);
    std::span<const Probe> probes() const override { return probes_; }
    State start(Turn) const override;
    Result<void> respond(std::span<const double> force, State&, Answer&) const override;
};

}  // namespace corpuscle
