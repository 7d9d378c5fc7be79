#include "study/study.hpp"

#include <fmt/format.h>
#include <mutex>
#include <numeric>
#include <optional>

#include "signal/pool.hpp"

namespace corpuscle {
namespace {

/// How far several are, asked and told by one thread at a time.
class Together {
    const StudyOptions& options_;
    std::mutex guard_;
    std::vector<double> shares_;
    std::optional<Error> error_;

public:
    Together(const StudyOptions& options, std::size_t count) : options_(options), shares_(count) {}

    bool keep_on(std::size_t which, double share) {
        const std::lock_guard lock(guard_);
        shares_[which] = share;
        return !error_ && options_.keep_on(std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size()));
    }
    void fail(std::string_view name, Error error) {
        const std::lock_guard lock(guard_);
        if (error_) return;
        if (error.code != Code::interrupted) error.sentence = fmt::format("{}: {}", name, error.sentence);
        error_ = std::move(error);
    }
    const std::optional<Error>& error() const { return error_; }
};

}  // namespace

Result<std::vector<Outcome>> run_studies(std::span<const Study* const> studies, const StudyOptions& options) {
    std::vector<Outcome> outcomes(studies.size());
    Together together(options, studies.size());
    Pool pool;
    pool.each(studies.size(), [&](std::size_t k, unsigned) {
        auto outcome = studies[k]->run({[&, k](double share) { return together.keep_on(k, share); }, options.recordings});
        outcome ? void(outcomes[k] = std::move(*outcome)) : together.fail(studies[k]->name, outcome.error());
    });
    if (together.error()) return *together.error();
    return outcomes;
}

}  // namespace corpuscle
