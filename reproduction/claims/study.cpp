#include "reproduction/claims/study.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <optional>

#include "core/thread_pool.hpp"

namespace corpuscle {
namespace {

/// Progress and first error of several studies that run on different threads.
class StudyProgress {
    const StudyOptions& options_;
    std::mutex mutex_;
    std::vector<double> fractions_;  // completed fraction of each study
    std::optional<Error> error_;

public:
    StudyProgress(const StudyOptions& options, std::size_t count) : options_(options), fractions_(count) {}

    /// Sets the completed fraction of a study. Returns false if all studies must stop.
    bool update(std::size_t index, double fraction) {
        const std::lock_guard lock(mutex_);
        fractions_[index] = fraction;
        return !error_ && options_.should_continue(std::accumulate(fractions_.begin(), fractions_.end(), 0.0) /
                                                   static_cast<double>(fractions_.size()));
    }
    /// Keeps the error of the study with this name, if it is the first error.
    void fail(std::string_view name, Error error) {
        const std::lock_guard lock(mutex_);
        if (error_) return;
        if (error.code != ErrorCode::interrupted) error.message = fmt::format("{}: {}", name, error.message);
        error_ = std::move(error);
    }
    const std::optional<Error>& error() const { return error_; }
};

}  // namespace

Result<std::string> StudyOptions::recordings_in(std::string_view folder) const {
    const auto path = fmt::format("{}/{}", recordings_folder, folder);
    if (std::filesystem::is_directory(path)) return path;
    return bad_input(fmt::format("no recording in '{}'; CORPUSCLE_DATA must name the folder that contains '{}'", path, folder));
}

Result<std::vector<StudyResult>> run_studies(std::span<const Study* const> studies, const StudyOptions& options) {
    std::vector<StudyResult> outcomes(studies.size());
    StudyProgress progress(options, studies.size());
    ThreadPool pool;
    pool.for_each(studies.size(), [&](std::size_t k, unsigned) {
        auto outcome =
            studies[k]->run({[&, k](double fraction) { return progress.update(k, fraction); }, options.recordings_folder, options.kit});
        outcome ? void(outcomes[k] = std::move(*outcome)) : progress.fail(studies[k]->name, outcome.error());
    });
    if (progress.error()) return *progress.error();
    return outcomes;
}

}  // namespace corpuscle
