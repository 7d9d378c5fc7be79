// The two digital systems that the thesis sets out to replace, whole (sensor, transducer, converter, words), beside its own models
// under the press. What each paper's system answers is told in the thesis's words (2.2, 3.1); values are ours.

#include <cmath>

#include "measure/distance.hpp"
#include "measure/measures.hpp"
#include "study/studies.hpp"
#include "study/trains.hpp"

namespace corpuscle::studies::fig8_9 {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Stretch up{0.25, 0.375}, late{0.525, 0.625}, down{0.625, 0.75};

void tell(Outcome& out, const std::string& name, const std::vector<double>& train) {
    out.claims.push_back({name + ": peak going up", measure<PeakRate>(train, up), "Hz", none, none, none, ""});
    out.claims.push_back({name + ": spikes in the plateau's last 100 ms", measure<SpikeCount>(train, late), "", none, none, none, ""});
    out.claims.push_back({name + ": spikes going down", measure<SpikeCount>(train, down), "", none, none, none, ""});
}

Plot::Series frequency(const std::string& name, const std::vector<double>& train) {
    const auto rates = instantaneous_rates(train);
    return {name, {train.begin(), train.begin() + static_cast<std::ptrdiff_t>(rates.size())}, rates, Plot::Style::points};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    Plot spikes{"Spikes under the press", "time (s)", "", {}}, rates{"Instantaneous frequency", "time (s)", "frequency (Hz)", {}};
    double done = 0;
    for (const char* name : {"sa1", "sa1-kim", "fa1", "fa1-lee"}) {
        const auto train = train_of({name});
        if (!train) return train.error();
        tell(out, name, *train);
        spikes.series.push_back({name, *train, {}, Plot::Style::raster});
        rates.series.push_back(frequency(name, *train));
        if (!options.keep_on(done += 0.25)) return Error{Code::interrupted, "interrupted"};
    }
    const auto& trains = spikes.series;
    const auto apart = [&](std::size_t a, std::size_t b) { return std::sqrt(van_rossum_squared(trains[a].x, trains[b].x, 20e-3)); };
    out.claims.push_back({"sa1-kim from sa1: van Rossum, 20 ms", apart(0, 1), "", none, none, none, ""});
    out.claims.push_back({"fa1-lee from fa1: van Rossum, 20 ms", apart(2, 3), "", none, none, none, ""});
    const std::string told = "thesis 3.1";
    const auto kim = measure<SpikeCount>(trains[1].x, down), own = measure<SpikeCount>(trains[0].x, down);
    out.claims.push_back({"sa1-kim fires in retraction, more than sa1, by", kim - own, "spikes", none, 1, none, told});
    out.claims.push_back({"fa1-lee: spikes in the plateau's last 100 ms", measure<SpikeCount>(trains[3].x, late), "", none, 0, 0, told});
    out.claims.push_back({"fa1-lee: spikes going down", measure<SpikeCount>(trains[3].x, down), "", none, 1, none, told});
    out.plots = {std::move(spikes), std::move(rates)};
    out.notes = {
        "SA-IA adds the size of the force's slope whatever its sign, so Kim's system answers release as it answers touch; the thesis "
        "calls that more suitable to SA-II and replaces it by high-passes that keep their sign.",
        "FA-IA is the bare slope, which ends with the ramp; FA-IB's high-pass of 2 Hz goes on for some 130 ms.",
        "Neither paper's values are in the thesis. Sensor, converter (12 bits, 1 kHz) and words are a choice: corpuscle list sa1-kim."};
    return out;
}

const Study study{"fig8-9", "The two digital systems that came before, and the thesis's models, under the press",
                  "What do Kim's and Lee's systems answer where the thesis's models answer? Thesis 2.2, 3.1, figs. 8 and 9", work};

}  // namespace corpuscle::studies::fig8_9
