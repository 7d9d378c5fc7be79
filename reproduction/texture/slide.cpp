#include "reproduction/texture/slide.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/recording/recording.hpp"

namespace corpuscle {
namespace {

using Taxels = std::vector<std::vector<double>>;

/// All values of a recording.
Result<Taxels> read_values(const std::string& path, const RecordingOptions& options) {
    const auto source = TRY(open_recording(path, options));
    Taxels out(source->channels().size());
    for (Frames block(out.size(), 1024);;) {
        TRY(source->read(block));
        if (block.count == 0) return out;
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c].insert(out[c].end(), block.force[c].begin(), block.force[c].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

double mean_of(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()); }

double deviation_of(const std::vector<double>& v) {
    const double mean = mean_of(v);
    double squares = 0;
    for (const double x : v) squares += (x - mean) * (x - mean);
    return std::sqrt(squares / static_cast<double>(v.size()));
}

/// For each taxel, the mean over the recordings of the deviation of its readings.
std::vector<double> mean_depths(const std::vector<Slide>& slides) {
    std::vector<double> out(slides.front().counts.frames.size());
    for (const auto& s : slides)
        for (std::size_t c = 0; c < out.size(); ++c) out[c] += deviation_of(s.counts.frames[c]) / static_cast<double>(slides.size());
    return out;
}

/// force = level + gain * (reading - zero), at least 0.
struct TaxelScale {
    double zero, gain, level;
    std::vector<double> operator()(std::vector<double> readings) const {
        for (double& x : readings) x = std::max(0.0, level + gain * (x - zero));
        return readings;
    }
};

}  // namespace

Result<void> read_slide(Slide& slide, const std::string& folder, std::optional<double> lowpass) {
    const auto path = folder + "/" + slide.name + ".csv";
    RecordingOptions options{.channels = {"3-18"}, .rate = slide_frame_rate, .scale = 1};  // 1 and 2 are proximity
    options.lowpass = lowpass;
    slide.counts.frames = TRY(read_values(path, options));
    options.resample = slide_force_rate, options.interpolation = Interpolation::smooth;
    slide.counts.smooth = TRY(read_values(path, options));
    return {};
}

std::vector<TaxelValues> slide_forces(const std::vector<Slide>& slides, SlidePart part, double newtons_per_count) {
    const auto depths = mean_depths(slides);
    std::vector<TaxelValues> out;
    for (const auto& s : slides) {
        auto& forces = out.emplace_back();
        for (std::size_t c = 0; c < depths.size(); ++c) {
            const auto& frames = s.counts.frames[c];
            const double depth = part == SlidePart::change_shape ? deviation_of(frames) : depths[c];
            const auto scale = part == SlidePart::all ? TaxelScale{0, newtons_per_count, 0}
                                                      : TaxelScale{mean_of(frames), slide_depth / depth, slide_level};
            forces.frames.push_back(scale(frames)), forces.smooth.push_back(scale(s.counts.smooth[c]));
        }
    }
    return out;
}

}  // namespace corpuscle
