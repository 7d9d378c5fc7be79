#pragma once
// An afferent behind a front end without a converter. The input of the inner afferent, which can be any, is not the force but the
// calibrated reading of the sensor, in newtons.

#include <memory>

#include "model/sensor/front_end.hpp"

namespace corpuscle {

class FrontEndAfferent final : public Afferent {
    FrontEnd front_end_;
    std::unique_ptr<Afferent> inner_;
    std::string name_, inner_format_, format_;
    std::vector<Probe> probes_;  // outputs of the front end's stages, the calibrated force, probes of the inner afferent
    std::size_t inner_values_;   // number of state values of the inner afferent

    std::vector<double> calibrated_block(std::span<const double> force, State&, ResponseBlock&) const;

public:
    FrontEndAfferent(FrontEnd, std::unique_ptr<Afferent>);
    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override;
    Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const override;
};

}  // namespace corpuscle
