#pragma once
// The surfaces of the texture task: their recordings, and a task for each part of the readings.

#include "reproduction/texture/texture_task.hpp"

namespace corpuscle {

inline constexpr double texture_scale = 10e-3;  ///< N in a count; the mean reading is then 1.2 N or 2.0 N, within the thesis's 0.2 to 4 N
inline constexpr double texture_window = 2;     ///< s, duration of a trial
inline constexpr std::size_t texture_taxels = 16;
inline constexpr double texture_lowpass = 3;  ///< Hz; above twice the frequency of the finer grating, below most of the sensor's noise

/// The features of a read-out, and their name in texts.
struct TextureReader {
    const char* name;
    std::vector<std::string> features;
};

/// Fabrics or gratings: their recordings, and the task with each part of their readings.
struct TextureSurfaces {
    const char* name;
    double chance;  ///< the accuracy of a guess
    std::vector<Slide> slides = {};
    std::map<SlidePart, TextureTask> tasks = {};
};

/// Three fabrics, each with two grips (120 and 210 counts) and two speeds (20 and 100 mm/s).
Result<TextureSurfaces> read_fabrics(const std::string& folder);
/// Two gratings, one recording of each at 5 mm/s.
Result<TextureSurfaces> read_gratings(const std::string& folder);
/// The same behind a low-pass filter, texture_lowpass.
Result<TextureSurfaces> read_slow_gratings(const std::string& folder);

/// A task with these features: sa1, fa1, sa1-nerve, fa1-nerve (numbers of spikes of these models), mean, change (of the readings).
Result<TextureTask> make_texture_task(const std::vector<Slide>&, const std::vector<TaxelValues>& forces, double window = texture_window);

}  // namespace corpuscle
