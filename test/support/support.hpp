#pragma once
// Helpers of many tests: they run one afferent under one force, read files, and locate the shared recordings.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "core/stimulus/stimuli.hpp"
#include "model/catalog.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::test {

struct RunSettings {
    std::vector<std::string> settings = {};  ///< of the afferent and the stimulus, each as "sa1.f_B=25Hz"
    double rate = 10e3;                      ///< sampling rate of the force, Hz
    Method method = Method::exact;
    bool sampled = false;      ///< true: spikes only at sample times
    std::size_t block = 4096;  ///< samples per call of respond()
    std::uint64_t seed = 0;    ///< of the stimulus
};

/// The value of a result; throws its error.
template <class T>
T value_or_throw(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().text());
    return std::move(*result);
}

/// The result of overrides that all must have been used; throws an error or the unused ones.
template <class T>
T applied_or_throw(Result<Applied<T>> result) {
    auto applied = value_or_throw(std::move(result));
    if (!applied.unused.empty()) throw std::runtime_error("unused: " + applied.unused[0].text());
    return std::move(applied.result);
}

inline std::vector<ParameterOverride> parse_settings(const std::vector<std::string>& settings, std::string_view option = "") {
    return value_or_throw(parse_overrides(settings, option));
}

/// The afferent of this name, with the settings of `run`.
inline std::unique_ptr<Afferent> afferent(const std::string& name, const RunSettings& run = {}) {
    return make_afferent(value_or_throw(plan_afferent(name, parse_settings(run.settings))).result, {1 / run.rate, run.method, run.sampled});
}

/// Samples (N) of a stimulus.
inline std::vector<double> force(const std::string& stimulus, const RunSettings& run = {}) {
    const auto overrides = parse_settings(run.settings);
    return value_or_throw(read_channel(*value_or_throw(make_stimulus(stimulus, overrides, run.rate, run.seed)).result));
}

/// The spikes of an afferent under a force f (N), which it receives in blocks of `block` samples.
inline std::vector<Spike> spikes(const Afferent& a, const std::vector<double>& f, std::size_t block = 4096) {
    std::vector<Spike> out;
    ResponseBlock response{out};
    auto state = a.start();
    for (std::size_t k = 0; k < f.size(); k += block)
        if (auto ok = a.respond(std::span(f).subspan(k, std::min(block, f.size() - k)), state, response); !ok)
            throw std::runtime_error(ok.error().text());
    return out;
}

/// Spike times (s), from the start of the stimulus, of the named afferent. The settings of `run` apply to the afferent and the stimulus.
inline std::vector<double> train(const std::string& name, const std::string& stimulus = "press", const RunSettings& run = {}) {
    return spike_times(spikes(*afferent(name, run), force(stimulus, run), run.block), value_or_throw(make_clock(run.rate)));
}

/// The names of all named afferents, of every receptor with every neuron, and of some of these behind each kind of front end.
inline std::vector<std::string> all_afferent_names() {
    std::vector<std::string> all;
    for (const auto& a : named_afferents()) all.emplace_back(a.name);
    for (const auto& r : receptor_entries())
        for (const auto& n : neuron_entries()) all.push_back(std::string(r.name) + "+" + std::string(n.name));
    for (const auto* with_front_end : {"fsr+sa1", "fsr+f2v+sa1", "fsr+f2i+fa1", "fsr+f2i+sa1b+izhikevich", "adc+sa1", "adc+sa1a+adaptive",
                                       "fsr+adc+fa1b+lif-a", "fsr+f2i+adc+fa1"})
        all.emplace_back(with_front_end);
    return all;
}

inline std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// A temporary directory of the running test; the destructor removes it.
class TemporaryFolder {
    std::filesystem::path path_;

public:
    TemporaryFolder() {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::temp_directory_path() / ("corpuscle-test-" + std::to_string(::getpid()) + "-" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(*this / name, std::ios::binary) << text;
        return *this / name;
    }
    /// The names, without folders, of all files and folders in it, sorted.
    std::vector<std::string> file_names() const {
        std::vector<std::string> all;
        for (const auto& e : std::filesystem::recursive_directory_iterator(path_)) all.push_back(e.path().filename().string());
        std::sort(all.begin(), all.end());
        return all;
    }
};

/// The path of a third-party recording. These are not part of the source tree, but in the folder $CORPUSCLE_DATA, by default ../shared/data
/// beside the source tree.
inline std::string shared_file_path(const std::string& name) {
    const char* set = std::getenv("CORPUSCLE_DATA");
    return (std::filesystem::path(set ? set : source_root() + "/../shared/data") / name).lexically_normal().string();
}

}  // namespace corpuscle::test

/// Skips the test with a message if a shared file is not on this machine.
#define CORPUSCLE_NEEDS(path)                                                                                      \
    if (!std::filesystem::exists(path)) {                                                                          \
        GTEST_SKIP() << "ABSENT: " << (path) << "\nTest skipped; set CORPUSCLE_DATA to the folder of recordings."; \
    }
